#include "talus/formats/changes.h"

#include <cmath>

#include "scenario/read_document.h"
#include "toml/field_path.h"
#include "toml/file_text.h"
#include "toml/scalar_text.h"
#include "toml/wording.h"
#include "toml/write_document.h"

namespace talus::formats {

namespace {

using toml::Document;

/// As the reader writes fields: joint."default".cohesion is joint.default.cohesion.
std::string fieldName(const toml::FieldPath& path) {
    std::string name;
    for (const toml::PathPart& part : path)
        name = std::holds_alternative<std::string>(part)
                   ? toml::joinField(name, std::get<std::string>(part))
                   : toml::elementField(name, std::get<std::size_t>(part));
    return name;
}

std::string enclosingTable(const std::string& field) { return field.substr(0, field.rfind('.')); }

/// Whether an error is about what was changed: the field itself, part of it, or, where the file has no such table, what is
/// missing in the one that it made.
bool isAbout(const Error& error, const std::string& changed) {
    const bool inside = error.field.starts_with(changed) &&
                        (error.field.size() == changed.size() || error.field[changed.size()] == '[');
    const bool around = changed.starts_with(error.field + ".");
    const bool beside = enclosingTable(error.field) == enclosingTable(changed);
    return inside || (error.line == 0 && !error.field.empty() && (around || beside));
}

/// \return what is wrong with a change, or nothing
std::optional<std::string> change(Document& document, const FieldChange& wish) {
    const auto path = toml::parseField(wish.field);
    if (!path) {
        return "is not the path of a field, allowed: one such as joint.default.friction_deg or "
               "water[0].depth";
    }
    if (!wish.value.starts_with('[') && !wish.value.starts_with('{'))
        return document.set(*path, toml::scalarOf(wish.value));
    const auto parsed = Document::parse("value = " + wish.value, kChangedBy);
    if (!parsed) {
        return "found " + toml::quoted(wish.value) +
               ", allowed: an array or a table as the file would have it, such as [0.2, 0.1, 0.1] or "
               "[\"c1r2s1\"]";
    }
    return document.set(*path, *parsed->root().find("value"));
}

/// Puts the values into the document; faults of values and of paths that lead nowhere.
std::vector<Error> change(Document& document, const std::vector<FieldChange>& changes) {
    std::vector<Error> faults;
    for (const FieldChange& wish : changes)
        if (const auto fault = change(document, wish)) faults.push_back({wish.field, *fault, kChangedBy});
    return faults;
}

/// The joint or material of a changed field, where the file has others but not that one.
std::optional<std::string> unknownName(const Document& document, const toml::FieldPath& path) {
    const auto* section = path.size() < 3 ? nullptr : std::get_if<std::string>(&path[0]);
    const auto* name = path.size() < 3 ? nullptr : std::get_if<std::string>(&path[1]);
    if (section == nullptr || name == nullptr || (*section != "joint" && *section != "material"))
        return std::nullopt;
    const auto tables = document.root().find(*section);
    if (!tables || tables->kind() != toml::Kind::table || tables->find(*name)) return std::nullopt;
    std::vector<std::string> known;
    for (const toml::Entry& entry : tables->entries()) known.push_back(entry.key);
    return "found the unknown " + *section + " " + toml::quoted(*name) + toml::suggestion(*name, known);
}

/// Changes of joints and materials that the file does not have: they are added, and may lack what is required. \pre the paths are ones
std::vector<Error> unknownNames(const Document& document, const std::vector<FieldChange>& changes) {
    std::vector<Error> faults;
    for (const FieldChange& wish : changes)
        if (const auto path = toml::parseField(wish.field))
            if (auto fault = unknownName(document, *path))
                faults.push_back({wish.field, std::move(*fault), kChangedBy});
    return faults;
}

/// Errors of changed fields are said of who changed them: the file has no such line.
std::vector<Error> ofChanges(const std::vector<FieldChange>& changes, std::vector<Error> errors) {
    for (const FieldChange& wish : changes) {
        const auto path = toml::parseField(wish.field);
        if (!path) continue;
        for (Error& error : errors)
            if (isAbout(error, fieldName(*path))) {
                error.file = kChangedBy;
                error.line = error.column = 0;
            }
    }
    return errors;
}

}  // namespace

Result<Scenario> readScenario(const std::string& path, const std::vector<FieldChange>& changes,
                              const std::atomic<bool>* stop,
                              const std::function<void(const Progress&)>& progress) {
    const bool from_stdin = path == "-";
    const std::string name = from_stdin ? "stdin" : path;
    const auto text = from_stdin ? toml::readStandardInput(name) : toml::readFileText(path);
    if (!text) return text.errors();
    constexpr double kLarge = 5e6;  // [bytes] takes a second
    if (const auto size = static_cast<double>(text->size()); progress && size > kLarge)
        progress({"reading", 0.0, std::to_string(std::lround(1e-6 * size)) + " MB of text"});
    auto document = Document::parse(*text, name);
    if (!document) return document.errors();
    if (changes.empty())
        return scenario::readDocument(*document, *text, name, kMostBlocks, stop, nullptr, progress);
    const std::vector<Error> unknown = unknownNames(*document, changes);
    if (auto faults = change(*document, changes); !faults.empty()) return faults;
    auto scenario = scenario::readDocument(*document, toml::writeDocument(*document), name, kMostBlocks, stop,
                                           nullptr, progress);
    if (!scenario) return unknown.empty() ? ofChanges(changes, scenario.errors()) : unknown;
    for (const FieldChange& wish : changes)
        scenario->places[fieldName(*toml::parseField(wish.field))] = {0, 0};
    return scenario;
}

}  // namespace talus::formats
