#include "scenario/fields.h"

namespace talus::formats::scenario {

namespace {

template <class Fields>
std::optional<std::string_view> unitIn(const Fields& fields, std::string_view key) {
    for (const auto& field : fields)
        if (field.key == key) return field.unit;
    return std::nullopt;
}

struct Unit {
    std::string_view key, unit;
};

/// Of keys that stand for more than one number of the model, or for none by itself.
constexpr std::array kOtherUnits{Unit{"depth", "m"},
                                 Unit{"elevation", "m"},
                                 Unit{"head", "m"},
                                 Unit{"base", "m"},
                                 Unit{"block", "m"},
                                 Unit{"origin", "m"},
                                 Unit{"velocity", "m/s"},
                                 Unit{"force", "N"},
                                 Unit{"point", "m"},
                                 Unit{"pressure", "Pa"},
                                 Unit{"pretension", "N"},
                                 Unit{"yield_force", "N"},
                                 Unit{"area", "m^2"},
                                 Unit{"modulus", "Pa"},
                                 Unit{"bond_stiffness", "N/m^2"},
                                 Unit{"bond_strength", "N/m"},
                                 Unit{"spacing", "m"},
                                 Unit{"length", "m"},
                                 Unit{"end", "m"},
                                 Unit{"surface", "m"},
                                 Unit{"acceleration", "m/s^2"},
                                 Unit{"shear_strength", "Pa"}};

}  // namespace

std::optional<JointField> jointField(const FieldPath& path) {
    if (path.size() != 3 || path[0] != PathPart(std::string("joint"))) return std::nullopt;
    const auto* joint = std::get_if<std::string>(&path[1]);
    const auto* key = std::get_if<std::string>(&path[2]);
    if (!joint || !key) return std::nullopt;
    return JointField{*joint, *key};
}

std::string unitOf(std::string_view field) {
    const std::string_view key = lastKey(field);
    if (key.ends_with("_deg")) return "deg";
    if (key.ends_with("_s")) return "s";
    if (key.ends_with("_m")) return "m";
    if (key == "shear_stiffness" && field.starts_with("bolt")) return "N/m";
    for (const auto& unit : {unitIn(kJointProperties, key), unitIn(kGravityFields, key),
                             unitIn(kWaterFields, key), unitIn(kOtherUnits, key)})
        if (unit) return std::string(*unit);
    std::optional<std::string_view> of_section;
    eachNumberSection([&](std::string_view, const auto& fields, auto) {
        if (!of_section) of_section = unitIn(fields, key);
    });
    if (of_section) return std::string(*of_section);
    return "";
}

}  // namespace talus::formats::scenario
