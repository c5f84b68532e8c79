#pragma once
// Help as wide as the terminal.

#include <CLI/CLI.hpp>
#include <string>

namespace talus::tools {

/// CLI11's help, wrapped; in narrow terminals the meaning of an option is below it.
class HelpFormatter : public CLI::Formatter {
 public:
    explicit HelpFormatter(std::size_t width) : width_(width) {}

    std::string make_option(const CLI::Option* option, bool is_positional) const override;
    std::string make_subcommand(const CLI::App* command) const override;
    std::string make_description(const CLI::App* app) const override;
    std::string make_usage(const CLI::App* app, std::string name) const override;
    std::string make_footer(const CLI::App* app) const override;

 private:
    std::string entry(const std::string& name, const std::string& meaning) const;
    std::size_t width_;
};

}  // namespace talus::tools
