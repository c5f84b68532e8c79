#pragma once
// The one table of joint properties: key, unit of input, allowed range, laws of strength that have it,
// default, and whether strength reduction divides it. All code that reads, writes, draws, reduces, stores or
// checks joints uses the table. A new property is a value of Joint (talus/joint_values.h), a line of the
// table, and the law that uses it.

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "talus/interval.h"
#include "talus/joint_values.h"

namespace talus {

struct JointProperty {
    std::string_view key;              ///< in a scenario
    double Joint::*value;              ///< in SI units and radians
    std::string_view unit;             ///< of the value under the key
    Interval allowed;                  ///< in that unit
    UnitMixUp mix_up{};                ///< likewise
    LawSet laws = kAllLaws;            ///< laws that have it
    LawSet required_by{};              ///< laws for which it must be given; else the default of Joint{} holds
    double Joint::*same_as = nullptr;  ///< ... or the value of this property
    LawSet reduced_in{};               ///< laws for which the factor of safety divides it, an angle by its
                                       ///< tangent
    std::string_view in_law;  ///< its name in the law and in snapshots; "" where they do not store it
    std::string_view what;    ///< for people

    /// The law takes an angle's tangent.
    constexpr bool isAngle() const { return unit == "deg"; }
    constexpr double toSi() const { return isAngle() ? 3.14159265358979323846 / 180 : 1.0; }
};

namespace detail {

// Wide enough for any rock, soil or laboratory model, and no wider than what doubles carry.
//
// A block closes its joint by rho g / k times its height under its own weight: below 1e3 Pa/m even foam
// blocks overlap completely. A cubic metre of rock on joints of 1e15 Pa/m closes them by 3e-11 m, a thousand
// times the rounding of coordinates of some metres. Values between are checked against the model itself
// (checks/plausible.h). Intact rock has 1e8 Pa of strength and 1e11 Pa of modulus. Unbreakable bonds have
// 1e15 Pa, the most that sums of forces should carry.
inline constexpr Interval kStiffness{1e3, 1e15}, kStrength{0, 1e15};
inline constexpr Interval kFrictionDeg{0, 90, false, true};
// pi/2 radians are 90 degrees; and no joint of a slope slides at a degree and a half.
inline constexpr UnitMixUp kStiffnessMixUp{0, 1e6, "kPa/m or MPa/m"}, kStrengthMixUp{0, 1, "kPa or MPa"},
    kFrictionMixUp{0, 1.5708, "radians"};
inline constexpr LawSet kCoulomb{StrengthLaw::coulomb}, kBartonBandis{StrengthLaw::barton_bandis},
    kPower{StrengthLaw::power};

}  // namespace detail

// The order is that of their names in messages.
inline constexpr std::array kJointProperties{
    JointProperty{.key = "normal_stiffness",
                  .value = &Joint::normal_stiffness,
                  .unit = "Pa/m",
                  .allowed = detail::kStiffness,
                  .mix_up = detail::kStiffnessMixUp,
                  .required_by = kAllLaws,
                  .in_law = "normal_stiffness",
                  .what = "normal stress per closure"},
    JointProperty{.key = "shear_stiffness",
                  .value = &Joint::shear_stiffness,
                  .unit = "Pa/m",
                  .allowed = detail::kStiffness,
                  .mix_up = detail::kStiffnessMixUp,
                  .required_by = kAllLaws,
                  .in_law = "shear_stiffness",
                  .what = "shear stress per slip before sliding"},
    JointProperty{.key = "friction_deg",
                  .value = &Joint::friction,
                  .unit = "deg",
                  .allowed = detail::kFrictionDeg,
                  .mix_up = detail::kFrictionMixUp,
                  .laws = detail::kCoulomb,
                  .required_by = detail::kCoulomb,
                  .reduced_in = detail::kCoulomb,
                  .in_law = "tan_friction",
                  .what = "angle of friction, peak"},
    JointProperty{.key = "cohesion",
                  .value = &Joint::cohesion,
                  .unit = "Pa",
                  .allowed = detail::kStrength,
                  .mix_up = detail::kStrengthMixUp,
                  .laws = detail::kCoulomb,
                  .reduced_in = detail::kCoulomb,
                  .in_law = "cohesion",
                  .what = "shear strength without normal stress, peak"},
    JointProperty{.key = "tensile_strength",
                  .value = &Joint::tensile_strength,
                  .unit = "Pa",
                  .allowed = detail::kStrength,
                  .mix_up = detail::kStrengthMixUp,
                  .laws = detail::kCoulomb,
                  .in_law = "tensile_strength",
                  .what = "tension at which it opens"},
    JointProperty{.key = "residual_cohesion",
                  .value = &Joint::residual_cohesion,
                  .unit = "Pa",
                  .allowed = detail::kStrength,
                  .mix_up = detail::kStrengthMixUp,
                  .laws = detail::kCoulomb,
                  .reduced_in = detail::kCoulomb,
                  .in_law = "residual_cohesion",
                  .what = "cohesion after the first slip or opening"},
    JointProperty{.key = "residual_friction_deg",
                  .value = &Joint::residual_friction,
                  .unit = "deg",
                  .allowed = detail::kFrictionDeg,
                  .mix_up = detail::kFrictionMixUp,
                  .laws = {StrengthLaw::coulomb, StrengthLaw::barton_bandis},
                  .required_by = detail::kBartonBandis,
                  .same_as = &Joint::friction,
                  .reduced_in = detail::kCoulomb,
                  .in_law = "residual_tan_friction",
                  .what = "angle of friction after the first slip, or of a smooth joint"},
    JointProperty{.key = "dilation_deg",
                  .value = &Joint::dilation,
                  .unit = "deg",
                  .allowed = detail::kFrictionDeg,
                  .in_law = "tan_dilation",
                  .what = "opening per slip, as an angle"},
    JointProperty{.key = "softening_displacement",
                  .value = &Joint::softening_displacement,
                  .unit = "m",
                  .allowed = {0, 1e3},
                  .in_law = "softening_displacement",
                  .what = "opening or slip over which the peak strength falls to the residual; 0: at once"},
    JointProperty{.key = "restitution_normal",
                  .value = &Joint::restitution_normal,
                  .unit = "",
                  .allowed = {0, 1},
                  .in_law = "",
                  .what = "share of the normal speed that an impact gives back, in a run"},
    JointProperty{.key = "jrc",
                  .value = &Joint::jrc,
                  .unit = "",
                  .allowed = {0, 20},
                  .laws = detail::kBartonBandis,
                  .required_by = detail::kBartonBandis,
                  .in_law = "",
                  .what = "joint roughness coefficient"},
    JointProperty{.key = "jcs",
                  .value = &Joint::jcs,
                  .unit = "Pa",
                  .allowed = Interval::positive(1e15),
                  .mix_up = {0, 1e4, "MPa"},
                  .laws = detail::kBartonBandis,
                  .required_by = detail::kBartonBandis,
                  .in_law = "",
                  .what = "joint wall compressive strength"},
    // Largest angle at which strength still grows with the normal stress at any roughness: sin(2 phi) > 2 JRC
    // (pi/180) / ln 10.
    JointProperty{.key = "max_friction_deg",
                  .value = &Joint::max_friction,
                  .unit = "deg",
                  .allowed = {0, 80, true, false},
                  .mix_up = detail::kFrictionMixUp,
                  .laws = detail::kBartonBandis,
                  .in_law = "",
                  .what = "greatest angle of the strength over the normal stress"},
    JointProperty{.key = "a",
                  .value = &Joint::a,
                  .unit = "Pa^(1-b)",
                  .allowed = Interval::positive(1e15),
                  .laws = detail::kPower,
                  .required_by = detail::kPower,
                  .in_law = "",
                  .what = "strength at a normal stress of 1 Pa"},
    JointProperty{.key = "b",
                  .value = &Joint::b,
                  .unit = "",
                  .allowed = {0, 1, true, false},
                  .laws = detail::kPower,
                  .required_by = detail::kPower,
                  .in_law = "",
                  .what = "exponent of the normal stress"},
    JointProperty{.key = "strength_factor",
                  .value = &Joint::strength_factor,
                  .unit = "",
                  .allowed = Interval::positive(1e6),
                  .laws = kCurvedLaws,
                  .reduced_in = kCurvedLaws,
                  .in_law = "strength_factor",
                  .what = "times the law's shear strength"},
    JointProperty{.key = "residual_factor",
                  .value = &Joint::residual_factor,
                  .unit = "",
                  .allowed = {0, 1},
                  .laws = kCurvedLaws,
                  .in_law = "",
                  .what = "share of the law's shear strength that is left after the first slip"},
    JointProperty{.key = "wet_strength_factor",
                  .value = &Joint::wet_strength_factor,
                  .unit = "",
                  .allowed = {1e-3, 1},
                  .in_law = "",
                  .what = "times all strengths where water presses in the joint"},
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

/// Allowed factors of strength over time. A joint keeps a thousandth of its strength, so that the kinds of
/// strength that it has do not change with time. A factor of 10 and more is a percentage.
inline constexpr Interval kStrengthOverTime{1e-3, 10, false, true};

/// Whether it is a strength: what a factor of strength over time multiplies. All strengths of a joint change
/// together, the tensile one too: ice and clay carry tension as they carry shear.
inline bool isStrength(const Joint& joint, const JointProperty& property) {
    return property.reduced_in.has(joint.law) || property.value == &Joint::tensile_strength;
}

/// Whether strength reduction divides it.
inline bool isReduced(const Joint& joint, const JointProperty& property) {
    return property.reduced_in.has(joint.law) ||
           (joint.tension_reduced && property.value == &Joint::tensile_strength);
}

/// The contact law's parameter from a property: the tangent of an angle, else the value itself; times
/// `strength` where it is a strength, and over `factor` where strength reduction divides it.
inline double lawValue(const Joint& joint, const JointProperty& property, double factor = 1,
                       double strength = 1) {
    const double value = joint.*property.value;
    return (property.isAngle() ? std::tan(value) : value) * (isStrength(joint, property) ? strength : 1.0) /
           (isReduced(joint, property) ? factor : 1.0);
}

/// A joint with its strengths over `factor`.
inline Joint reduced(Joint joint, double factor) {
    for (const JointProperty& property : kJointProperties)
        if (isReduced(joint, property))
            joint.*property.value = property.isAngle() ? std::atan(lawValue(joint, property, factor))
                                                       : lawValue(joint, property, factor);
    return joint;
}

/// The factor of its strengths at a time [s]: linear between the entries of its table, constant beyond.
double strengthFactor(const Joint& joint, double time);

/// Whether that factor is not the same at all times.
bool changesStrength(const Joint& joint);

/// A joint with `factor` times the strengths.
Joint strengthened(Joint joint, double factor);

/// A joint whose strength is at all times what it is at this one [s]. Searches take time 0.
Joint strengthAt(Joint joint, double time);

/// A joint with `factor` times the stiffness.
inline Joint stiffened(Joint joint, double factor) {
    joint.normal_stiffness *= factor;
    joint.shear_stiffness *= factor;
    return joint;
}

/// A joint that neither slips nor opens below `strength` [Pa].
inline Joint holding(Joint joint, double strength) {
    joint.law = StrengthLaw::coulomb;
    joint.cohesion = joint.tensile_strength = joint.residual_cohesion = strength;
    return joint;
}

}  // namespace talus
