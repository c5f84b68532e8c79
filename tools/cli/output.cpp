// Output on stdout, and numbers and errors as text and JSON.

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "cli/failures.h"
#include "cli/json.h"
#include "cli/terminal.h"
#include "cli/text.h"

namespace talus::tools {

FileRefused::FileRefused(const std::string& path, const std::string& doing, int error_number)
    : std::runtime_error(path + ": " + doing + ": " + std::strerror(error_number)) {}

void printText(const std::string& text) {
    errno = 0;
    const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
    if (!written || std::fflush(stdout) != 0) throw FileRefused("stdout", "cannot be written", errno);
}

void printResult(const std::string& text) {
    printText(::isatty(STDOUT_FILENO) != 0 ? fitted(text, columnsOf(STDOUT_FILENO, 80)) : text);
}

std::string jsonText(const Json& json, int indent) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

std::string validUtf8(const std::string& text) {
    const bool is_ascii = std::all_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x80; });
    return is_ascii ? text : Json::parse(jsonText(text)).get<std::string>();
}

void printJson(const Json& json) { printText(jsonText(json, 2) + "\n"); }

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

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
