// What goes to stdout, and numbers and errors as text and JSON.

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "cli/command.h"

namespace talus::tools {

void addCommon(CLI::App& app, Common& common, bool computes) {
    app.add_flag("--json", common.json, "Print the result as one JSON object on stdout");
    app.add_flag("--quiet", common.quiet, "No progress and no notes on stderr");
    if (computes)
        app.add_option("--threads", common.threads, "Threads to compute with (0: all cores)")
            ->check(CLI::Range(0, 1024))
            ->capture_default_str();
}

FileRefused::FileRefused(const std::string& path, const std::string& doing, int error_number)
    : std::runtime_error(path + ": " + doing + ": " + std::strerror(error_number)) {}

formats::Scenario loadScenario(const std::string& path) { return valueOf(formats::readScenario(path)); }

formats::Scenario loadScenario(const std::string& path, const Common& common) {
    formats::Scenario scenario = loadScenario(path);
    for (const std::string& warning : scenario.warnings) note(common, "warning: " + path + ": " + warning);
    return scenario;
}

void printText(const std::string& text) {
    errno = 0;
    const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
    if (!written || std::fflush(stdout) != 0) throw FileRefused("stdout", "cannot be written", errno);
}

// Names come from files, so they may hold bytes that are not UTF-8; those must not stop a result from being printed.
void printJson(const Json& json) {
    printText(json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json vector(const Vec3& value) {
    return Json::array({number(value.x()), number(value.y()), number(value.z())});
}

std::string hashText(std::uint64_t state_hash) {
    std::array<char, 17> text{};
    std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(state_hash));
    return text.data();
}

std::string text(double value, int decimals) {
    if (!std::isfinite(value)) return value > 0 ? "infinite" : value < 0 ? "-infinite" : "undefined";
    std::array<char, 400> buffer;  // the largest double has 309 digits
    const auto end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, decimals)
            .ptr;
    return {buffer.data(), end};
}

Json errorsJson(const std::vector<Error>& errors) {
    Json list = Json::array();
    for (const Error& error : errors)
        list.push_back({{"file", error.file.empty() ? Json(nullptr) : Json(error.file)},
                        {"line", error.line > 0 ? Json(error.line) : Json(nullptr)},
                        {"column", error.column > 0 ? Json(error.column) : Json(nullptr)},
                        {"field", error.field},
                        {"message", error.message}});
    return {{"ok", false}, {"errors", list}};
}

}  // namespace talus::tools
