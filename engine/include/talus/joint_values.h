#pragma once
// A joint's values: which law its shear strength follows, and the numbers of that law.

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "talus/level_point.h"

namespace talus {

/// How the shear strength tau of a joint follows from the normal stress sigma_n on it.
enum class StrengthLaw : std::uint8_t {
    coulomb,        ///< tau = C + sigma_n tan(phi), brittle (eq 9 of the paper)
    barton_bandis,  ///< tau = sigma_n tan(phi_r + JRC log10(JCS / sigma_n)) (Barton and Choubey 1977)
    envelope,       ///< straight from point to point of a table
    power           ///< tau = a sigma_n^b
};
/// As scenarios and snapshots call them.
inline constexpr std::array<std::string_view, 4> kStrengthLawNames{"coulomb", "barton-bandis", "envelope",
                                                                   "power"};

constexpr std::string_view toString(StrengthLaw law) {
    return kStrengthLawNames[static_cast<std::size_t>(law)];
}

/// Some of them.
class LawSet {
 public:
    constexpr LawSet() = default;
    constexpr LawSet(std::initializer_list<StrengthLaw> laws) {
        for (const StrengthLaw law : laws) bits_ |= 1U << static_cast<unsigned>(law);
    }
    constexpr bool has(StrengthLaw law) const { return (bits_ >> static_cast<unsigned>(law) & 1U) != 0; }
    constexpr bool empty() const { return bits_ == 0; }

 private:
    unsigned bits_ = 0;
};
inline constexpr LawSet kCurvedLaws{StrengthLaw::barton_bandis, StrengthLaw::envelope, StrengthLaw::power};
inline constexpr LawSet kAllLaws{StrengthLaw::coulomb, StrengthLaw::barton_bandis, StrengthLaw::envelope,
                                 StrengthLaw::power};

/// A point of a tabulated strength [Pa].
struct EnvelopePoint {
    double normal_stress = 0, shear_strength = 0;
    friend bool operator==(const EnvelopePoint&, const EnvelopePoint&) = default;
};

/// Strength and stiffness of an interface (eqs 5-9 of the paper).
struct Joint {
    std::string name;
    StrengthLaw law = StrengthLaw::coulomb;
    double normal_stiffness = 0;   ///< k_n [Pa/m]
    double shear_stiffness = 0;    ///< k_s [Pa/m]
    double friction = 0;           ///< phi [rad]
    double cohesion = 0;           ///< C [Pa]
    double tensile_strength = 0;   ///< sigma_t [Pa]
    double residual_cohesion = 0;  ///< C_r, after the first slip or opening [Pa]
    double residual_friction =
        0;                ///< phi_r, after the first slip; to Barton and Bandis, of a smooth joint [rad]
    double dilation = 0;  ///< psi, opening per slip [rad]
    double softening_displacement = 0;  ///< opening or slip beyond its peak, over which it is lost [m]
    double restitution_normal = 1;      ///< e, share of the normal speed that an impact gives back
    double jrc = 0;                     ///< JRC, roughness [deg per decade of stress, as it is defined]
    double jcs = 0;                     ///< JCS, strength of the wall [Pa]
    double max_friction = 70 * (3.14159265358979323846 / 180);  ///< greatest angle of tau over sigma_n [rad]
    double a = 0;                ///< strength at a normal stress of 1 Pa [Pa^(1 - b)]
    double b = 0;                ///< exponent of the normal stress
    double strength_factor = 1;  ///< times the strength of a law that is not Coulomb's
    double residual_factor = 1;  ///< of that strength, after the first slip; of a law that is not Coulomb's
    double wet_strength_factor = 1;             ///< times all its strengths where water presses in it
    bool tension_reduced = false;               ///< strength reduction divides the tensile strength, too
    std::vector<EnvelopePoint> shear_strength;  ///< from zero normal stress upwards; the last slope goes on
    /// Factor of all its strengths over time, within kStrengthOverTime; empty: 1. Ice in joints loses
    /// strength as it warms (P. Mamot, S. Weber, T. Schroeder and M. Krautblatter, The Cryosphere 12, 3333,
    /// 2018).
    std::vector<LevelPoint> strength_over_time{};
};

/// Shear strength of an intact joint at a normal stress, compression positive [Pa].
double shearStrength(const Joint& joint, double normal_stress);

/// Angle of the secant of its strength at 100 kPa [rad]; of Coulomb's law without cohesion, phi. Where faces
/// of two joints meet, the joint with the smaller angle counts.
double frictionAngle(const Joint& joint);

}  // namespace talus
