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
    std::string_view section, key, unit;  ///< section "": any
};

/// Of keys that stand for more than one number of the model, or for none by itself.
constexpr std::array kOtherUnits{Unit{"", "depth", "m"},
                                 Unit{"", "elevation", "m"},
                                 Unit{"", "head", "m"},
                                 Unit{"", "base", "m"},
                                 Unit{"water", "overflow", "m"},
                                 Unit{"water", "inflow", "m^3/s per m"},
                                 Unit{"water", "rain", "mm/h"},
                                 Unit{"stack", "block", "m"},
                                 Unit{"", "origin", "m"},
                                 Unit{"", "offset", "m"},
                                 Unit{"", "spacing", "m"},
                                 Unit{"", "radius", "m"},
                                 Unit{"", "radius_deviation", "m"},
                                 Unit{"", "radius_min", "m"},
                                 Unit{"", "radius_max", "m"},
                                 Unit{"", "p32", "m^2/m^3"},
                                 Unit{"", "min_thickness", "m"},
                                 Unit{"rock_mass", "tolerance", "m"},
                                 Unit{"block", "tolerance", "m"},
                                 Unit{"rock_mass", "simplify", "m"},
                                 Unit{"", "largest_hole", "m"},
                                 Unit{"rock_mass", "shift", "m"},
                                 Unit{"rock_mass", "profile", "m"},
                                 Unit{"rock_mass", "y", "m"},
                                 Unit{"", "vertices", "m"},
                                 Unit{"", "min", "m"},
                                 Unit{"", "max", "m"},
                                 Unit{"", "velocity", "m/s"},
                                 Unit{"", "angular_velocity", "rad/s"},
                                 Unit{"", "force", "N"},
                                 Unit{"", "point", "m"},
                                 Unit{"", "pressure", "Pa"},
                                 Unit{"", "surface", "m"},
                                 Unit{"", "acceleration", "m/s^2"},
                                 Unit{"", "shear_strength", "Pa"},
                                 Unit{"bolt", "end", "m"},
                                 Unit{"bolt", "length", "m"},
                                 Unit{"bolt", "area", "m^2"},
                                 Unit{"bolt", "modulus", "Pa"},
                                 Unit{"bolt", "yield_force", "N"},
                                 Unit{"bolt", "pretension", "N"},
                                 Unit{"bolt", "bond_stiffness", "N/m^2"},
                                 Unit{"bolt", "bond_strength", "N/m"},
                                 Unit{"bolt", "shear_stiffness", "N/m"}};

std::optional<std::string_view> otherUnit(std::string_view field, std::string_view key) {
    for (const Unit& unit : kOtherUnits)
        if (unit.key == key && field.starts_with(unit.section)) return unit.unit;
    return std::nullopt;
}

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
    if (key == field) return "";  // a section
    if (key.ends_with("_deg")) return "deg";
    if (key.ends_with("_s")) return "s";
    if (key.ends_with("_m")) return "m";
    for (const auto& unit :
         {otherUnit(field, key), unitIn(kJointProperties, key), unitIn(kGravityFields, key),
          unitIn(kWaterFields, key), unitIn(kClosedWaterFields, key), unitIn(kFlowFields, key)})
        if (unit) return std::string(*unit);
    std::optional<std::string_view> of_section;
    eachNumberSection([&](std::string_view, const auto& fields, auto) {
        if (!of_section) of_section = unitIn(fields, key);
    });
    if (of_section) return std::string(*of_section);
    return "";
}

}  // namespace talus::formats::scenario
