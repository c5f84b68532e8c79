#include "cli/help.h"

#include "cli/terminal.h"

namespace talus::tools {

namespace {

constexpr std::size_t kNarrow = 72;  // below that names and meanings do not fit beside each other
constexpr std::size_t kNameColumn = 30;

}  // namespace

std::string HelpFormatter::entry(const std::string& name, const std::string& meaning) const {
    const std::string head = wrapped("  " + name, width_);
    if (width_ < kNarrow) return head + wrapped(meaning, width_, 6);
    const std::string text = wrapped(meaning, width_, kNameColumn);
    if (name.size() + 3 > kNameColumn || meaning.empty()) return head + text;
    return "  " + name + text.substr(name.size() + 2);
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
    return entry(make_option_name(option, is_positional) + make_option_opts(option),
                 make_option_desc(option));
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
    return entry(command->get_name(), command->get_description());
}

std::string HelpFormatter::make_description(const CLI::App* app) const {
    return wrapped(app->get_description() + "\n", width_);
}

std::string HelpFormatter::make_usage(const CLI::App* app, std::string name) const {
    return wrapped(CLI::Formatter::make_usage(app, std::move(name)), width_);
}

std::string HelpFormatter::make_footer(const CLI::App* app) const {
    return wrapped(app->get_footer(), width_);
}

}  // namespace talus::tools
