#include "talus/formats/changes.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "scenario/read_document.h"
#include "scenario/unnamed.h"
#include "toml/field_path.h"
#include "toml/file_text.h"
#include "toml/scalar_text.h"
#include "toml/wording.h"
#include "toml/write_document.h"

namespace talus::formats {

namespace {

using toml::Document;

/// Normalises a field as the reader does: joint."default".cohesion is joint.default.cohesion.
std::string fieldName(const toml::FieldPath& path) {
    std::string name;
    for (const toml::PathPart& part : path)
        name = std::holds_alternative<std::string>(part)
                   ? toml::joinField(name, std::get<std::string>(part))
                   : toml::elementField(name, std::get<std::size_t>(part));
    return name;
}

std::string enclosingTable(const std::string& field) { return field.substr(0, field.rfind('.')); }

/// Whether an error concerns a change: the field itself, part of it, or a key missing in a table that the
/// change added.
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
        return "is not the path of a field, allowed: a path such as joint.default.friction_deg or "
               "water[0].depth";
    }
    if (wish.value.find_first_of("[{\"") != 0) return document.set(*path, toml::scalarOf(wish.value));
    const auto parsed = Document::parse("value = " + wish.value, kChangedBy);
    // Behind a line break there may be more than the value.
    if (!parsed || parsed->root().size() != 1) {
        return "found " + toml::quoted(wish.value) +
               ", allowed: one array, table or text as written in a file, such as [0.2, 0.1, 0.1], "
               "[\"c1r2s1\"] or \"c1r2s1\"";
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

std::vector<std::string> keysIn(const Document& document, std::string_view section) {
    std::vector<std::string> keys;
    const auto tables = document.root().find(section);
    if (!tables || tables->kind() != toml::Kind::table) return keys;
    for (const toml::Entry& entry : tables->entries()) keys.push_back(entry.key);
    return keys;
}

/// Faults of the changes that add a joint or a material to those of the file.
std::vector<Error> unknownNames(const Document& document, const std::vector<FieldChange>& changes) {
    const scenario::KnownNames known{keysIn(document, "joint"), keysIn(document, "material")};
    std::vector<Error> faults;
    for (const FieldChange& wish : changes) {
        const auto path = toml::parseField(wish.field);
        auto fault = path ? scenario::unknownName(*path, known) : std::nullopt;
        if (fault) faults.push_back({fieldName(*path), std::move(*fault), kChangedBy});
    }
    return faults;
}

/// Missing keys of an added joint or material are reported as an unknown name: the addition was probably not
/// intended. Other faults stay.
std::vector<Error> sayUnknown(const std::vector<Error>& unknown, std::vector<Error> errors) {
    for (const Error& name : unknown) {
        const std::string table = enclosingTable(name.field) + ".";
        const auto lacks = [&](const Error& error) { return error.field.starts_with(table); };
        const auto first = std::find_if(errors.begin(), errors.end(), lacks);
        if (first == errors.end()) {
            // With a second material, blocks that name none lack one: the added material causes that fault.
            const bool leaves_open = std::any_of(errors.begin(), errors.end(), [](const Error& error) {
                return error.field.ends_with(".material");
            });
            if (leaves_open && table.starts_with("material.")) errors.insert(errors.begin(), name);
            continue;
        }
        *first = name;
        errors.erase(std::remove_if(std::next(first), errors.end(), lacks), errors.end());
    }
    return errors;
}

/// Errors of changed fields name kChangedBy: the file has no such line.
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
    if (!scenario) return sayUnknown(unknown, ofChanges(changes, scenario.errors()));
    for (const FieldChange& wish : changes)
        scenario->places[fieldName(*toml::parseField(wish.field))] = {0, 0};
    return scenario;
}

}  // namespace talus::formats
