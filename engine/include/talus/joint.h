#pragma once
// What a joint is made of: its values, and the one table that says of each how it is called, in which unit people give
// it, what is allowed, what it is when nobody gives it, and whether strength reduction divides it. Whoever reads, writes,
// draws, reduces, keeps or checks joints goes through the table: a new property is a value here, a line of the table, its
// place in a snapshot (formats/snapshot.fbs) and the law that uses it.

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "talus/interval.h"

namespace talus {

/// Strength and stiffness of an interface (Mohr-Coulomb, eqs 5-9 of the paper).
struct Joint {
    std::string name;
    double normal_stiffness = 0;   ///< k_n [Pa/m]
    double shear_stiffness = 0;    ///< k_s [Pa/m]
    double friction = 0;           ///< phi [rad]
    double cohesion = 0;           ///< C [Pa]
    double tensile_strength = 0;   ///< sigma_t [Pa]
    double residual_cohesion = 0;  ///< C_r, after the first slip or opening [Pa]
    double residual_friction = 0;  ///< phi_r, after the first slip [rad]
    double dilation = 0;           ///< psi, opening per slip [rad]
};

struct JointProperty {
    std::string_view key;   ///< in a scenario
    double Joint::*value;   ///< in SI units and radians
    std::string_view unit;  ///< of what stands under the key
    Interval allowed;       ///< in that unit
    enum class Default { required, zero, same_as } when_absent = Default::zero;
    double Joint::*same_as = nullptr;  ///< the property it follows unless it is given
    bool is_reduced = false;           ///< the factor of safety divides it, an angle by its tangent
    std::string_view in_law;  ///< what the law calls what it takes of it; so it is called in snapshots, too
    std::string_view what;    ///< for people

    /// The law takes an angle's tangent.
    constexpr bool isAngle() const { return unit == "deg"; }
    constexpr double toSi() const { return isAngle() ? 3.14159265358979323846 / 180 : 1.0; }
};

namespace detail {

inline constexpr Interval kFrictionDeg{0, 90, false, true};
using Default = JointProperty::Default;

}  // namespace detail

// The order is that of the parameters in the law (law/law.h), and of their names in messages.
inline constexpr std::array kJointProperties{
    JointProperty{.key = "normal_stiffness",
                  .value = &Joint::normal_stiffness,
                  .unit = "Pa/m",
                  .allowed = Interval::positive(),
                  .when_absent = detail::Default::required,
                  .in_law = "normal_stiffness",
                  .what = "normal stress per closure"},
    JointProperty{.key = "shear_stiffness",
                  .value = &Joint::shear_stiffness,
                  .unit = "Pa/m",
                  .allowed = Interval::positive(),
                  .when_absent = detail::Default::required,
                  .in_law = "shear_stiffness",
                  .what = "shear stress per slip before sliding"},
    JointProperty{.key = "friction_deg",
                  .value = &Joint::friction,
                  .unit = "deg",
                  .allowed = detail::kFrictionDeg,
                  .when_absent = detail::Default::required,
                  .is_reduced = true,
                  .in_law = "tan_friction",
                  .what = "angle of friction, peak"},
    JointProperty{.key = "cohesion",
                  .value = &Joint::cohesion,
                  .unit = "Pa",
                  .allowed = Interval::notNegative(),
                  .is_reduced = true,
                  .in_law = "cohesion",
                  .what = "shear strength without normal stress, peak"},
    JointProperty{.key = "tensile_strength",
                  .value = &Joint::tensile_strength,
                  .unit = "Pa",
                  .allowed = Interval::notNegative(),
                  .in_law = "tensile_strength",
                  .what = "tension at which it opens"},
    JointProperty{.key = "residual_cohesion",
                  .value = &Joint::residual_cohesion,
                  .unit = "Pa",
                  .allowed = Interval::notNegative(),
                  .is_reduced = true,
                  .in_law = "residual_cohesion",
                  .what = "cohesion after the first slip or opening"},
    JointProperty{.key = "residual_friction_deg",
                  .value = &Joint::residual_friction,
                  .unit = "deg",
                  .allowed = detail::kFrictionDeg,
                  .when_absent = detail::Default::same_as,
                  .same_as = &Joint::friction,
                  .is_reduced = true,
                  .in_law = "residual_tan_friction",
                  .what = "angle of friction after the first slip"},
    JointProperty{.key = "dilation_deg",
                  .value = &Joint::dilation,
                  .unit = "deg",
                  .allowed = detail::kFrictionDeg,
                  .in_law = "tan_dilation",
                  .what = "opening per slip, as an angle"},
};
inline constexpr std::size_t kJointPropertyCount = kJointProperties.size();

/// Place of a property in the table, by its key.
constexpr std::optional<std::size_t> jointProperty(std::string_view key) {
    for (std::size_t p = 0; p < kJointPropertyCount; ++p)
        if (kJointProperties[p].key == key) return p;
    return std::nullopt;
}

/// The same by its value; every value of a joint is in the table.
constexpr std::size_t jointProperty(double Joint::*value) {
    std::size_t p = 0;
    while (kJointProperties[p].value != value) ++p;
    return p;
}

constexpr const JointProperty& propertyOf(double Joint::*value) {
    return kJointProperties[jointProperty(value)];
}

/// What the contact law takes of a property: the tangent of an angle, anything else as it is; over `factor` where strength
/// reduction divides it.
inline double lawValue(const Joint& joint, const JointProperty& property, double factor = 1) {
    const double value = joint.*property.value;
    return (property.isAngle() ? std::tan(value) : value) / (property.is_reduced ? factor : 1.0);
}

/// A joint with its strengths over `factor`.
inline Joint reduced(Joint joint, double factor) {
    for (const JointProperty& property : kJointProperties)
        if (property.is_reduced)
            joint.*property.value = property.isAngle() ? std::atan(lawValue(joint, property, factor))
                                                       : lawValue(joint, property, factor);
    return joint;
}

/// A joint that neither slips nor opens below `strength` [Pa].
inline Joint holding(Joint joint, double strength) {
    joint.cohesion = joint.tensile_strength = joint.residual_cohesion = strength;
    return joint;
}

}  // namespace talus
