#include "scenario/changes.h"

#include <algorithm>

#include "toml/field_path.h"
#include "toml/scalar_text.h"
#include "toml/wording.h"

namespace talus::formats::scenario {

namespace {

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

}  // namespace

std::vector<Error> change(Document& document, const std::vector<FieldChange>& changes) {
    std::vector<Error> faults;
    for (const FieldChange& wish : changes) {
        const auto path = toml::parseField(wish.field);
        const auto fault =
            path ? document.set(*path, toml::scalarOf(wish.value))
                 : "is not the path of a field, allowed: one such as joint.default.friction_deg "
                   "or water[0].depth";
        if (fault) faults.push_back({wish.field, *fault, wish.origin});
    }
    return faults;
}

std::vector<Error> ofChanges(const std::vector<FieldChange>& changes, std::vector<Error> errors) {
    for (const FieldChange& wish : changes) {
        const auto path = toml::parseField(wish.field);
        if (!path) continue;
        for (Error& error : errors)
            if (isAbout(error, fieldName(*path))) {
                error.file = wish.origin;
                error.line = error.column = 0;
            }
    }
    return errors;
}

}  // namespace talus::formats::scenario
