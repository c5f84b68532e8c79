// Errors as text, and the place in a scenario of an error of the engine.

#include <tuple>

#include "talus/formats/changes.h"

namespace talus::formats {

namespace {

/// "water[1].walls" -> "water[1]" -> "water" -> "".
std::string enclosing(const std::string& field) {
    const auto end = field.find_last_of(".[");
    return end == std::string::npos ? "" : field.substr(0, end);
}

}  // namespace

std::vector<Error> placed(const Scenario& scenario, std::vector<Error> errors) {
    for (Error& error : errors) {
        const bool has_file = !error.file.empty();
        if (!has_file) error.file = scenario.path;
        if (error.line > 0) continue;
        for (std::string field = error.field; !field.empty(); field = enclosing(field)) {
            const auto place = scenario.places.find(field);
            if (place == scenario.places.end()) continue;
            std::tie(error.line, error.column) = place->second;
            if (error.line == 0 && !has_file) error.file = kChangedBy;
            break;
        }
    }
    return errors;
}

std::string format(const Error& error) {
    std::string text = error.file;
    if (error.line > 0) text += ":" + std::to_string(error.line);
    if (error.line > 0 && error.column > 0) text += ":" + std::to_string(error.column);
    text += text.empty() ? "error: " : ": error: ";
    return text + (error.field.empty() ? "" : error.field + ": ") + error.message;
}

}  // namespace talus::formats
