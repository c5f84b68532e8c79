#pragma once
// Numbers of the tables that are one value of the model each, other than a joint's (talus/joint.h). Reader,
// overrides and units use this list. And what a field of a scenario is, by its path.

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "scenario/reading.h"
#include "talus/model.h"
#include "toml/field_path.h"

namespace talus::formats::scenario {

template <class Owner>
struct NumberField {
    std::string_view key;
    double Owner::*value;   ///< in SI units and radians
    std::string_view unit;  ///< of what stands under the key
    Interval allowed;       ///< in that unit
    UnitMixUp mix_up{};     ///< likewise

    constexpr double toSi() const { return unit == "deg" ? kRadPerDeg : 1.0; }
};

// Geotechnical centrifuges reach some 1000 g.
inline constexpr Interval kGravity{0, 1e5};
inline constexpr UnitMixUp kGravityMixUp{9700, 9900, "mm/s^2"};
// The lightest model blocks are of foam, 10 kg/m^3; osmium has 22590.
inline constexpr Interval kDensity{10, 30000};
inline constexpr UnitMixUp kDensityMixUp{0, 100, "g/cm3, t/m3 or kN/m3"};
// From gases to mercury (13546).
inline constexpr Interval kFluidDensity{1, 30000};
inline constexpr UnitMixUp kFluidDensityMixUp{0, 30, "g/cm3, t/m3 or kN/m3"};
// Rocks fall at up to some 100 m/s; faster ones would meet as shock waves, not as rigid bodies.
inline constexpr Interval kSpeed{-1000, 1000};  ///< [m/s]
// Falling rocks turn at up to some 50 rad/s. The step follows the stiffness, so faster ones would need more.
inline constexpr Interval kSpin{-1000, 1000};  ///< [rad/s]
// From a second before anything has moved to thirty years; longer than any history can be computed.
inline constexpr Interval kDuration = Interval::positive(1e9);  ///< [s]

inline constexpr std::array kGravityFields{
    NumberField<Gravity>{"magnitude", &Gravity::magnitude, "m/s^2", kGravity, kGravityMixUp},
    NumberField<Gravity>{"tilt_deg", &Gravity::tilt, "deg", kTiltDeg}};

inline constexpr std::array kSeismicFields{
    NumberField<Seismic>{"horizontal", &Seismic::horizontal, "", kNotNegative},
    NumberField<Seismic>{"direction_deg", &Seismic::azimuth, "deg", Interval{-360, 360, false, false}},
    NumberField<Seismic>{"vertical", &Seismic::vertical, "", Interval{-10, 1, false, true}}};

// The critical one of the stiffest block is some 1e8 per second; a dashpot slower than the history only holds
// it up.
inline constexpr Interval kDampingRate{0, 1e9}, kDampingTime{0, 1e3};

inline constexpr std::array kDampingFields{
    NumberField<Damping>{"mass", &Damping::mass, "1/s", kDampingRate},
    NumberField<Damping>{"rotation", &Damping::rotation, "1/s", kDampingRate},
    NumberField<Damping>{"contact", &Damping::contact, "s", kDampingTime},
    NumberField<Damping>{"local", &Damping::local, "", Interval{0, 1, false, true}}};

/// What a [[water]] of any kind has.
inline constexpr std::array kWaterFields{
    NumberField<Water>{"density", &Water::density, "kg/m^3", kFluidDensity, kFluidDensityMixUp},
    NumberField<Water>{"drains_at_aperture", &Water::drains_at_aperture, "m", kSize}};

/// What one with `volume = "closed"` has beside.
// Wider joints carry turbulent flow, for which the cubic law does not hold.
inline constexpr Interval kLeakAperture = Interval::positive(0.01);  ///< [m]
// No gully gathers the rain of more than a hundred kilometres.
inline constexpr Interval kCatchment = Interval::positive(1e5);  ///< [m]
inline constexpr std::array kClosedWaterFields{
    NumberField<Water>{"opening", &Water::opening, "m", kSize},
    NumberField<Water>{"catchment", &Water::catchment, "m", kCatchment},
    NumberField<Water>{"leak_aperture", &Water::leak_aperture, "m", kLeakAperture},
    NumberField<Water>{"leak_length", &Water::leak_length, "m", kSize}};
// A river of 10 m depth brings some 30 m^3/s per m; what flows into a fissure is far less.
inline constexpr Interval kInflow{0, 100, false, false};  ///< [m^3/s per m]
// The heaviest rain on record brought 38 mm in a minute (Guadeloupe, 1970), 2280 mm/h.
inline constexpr Interval kRain{0, 3000, false, false};            ///< [mm/h]
inline constexpr double kMetresPerSecond = 1.0 / (1000 * 3600.0);  ///< of 1 mm/h

// From fractures of tight rock to open caves; the cubic law is of fractions of a millimetre.
inline constexpr Interval kHydraulicAperture{1e-9, 0.1};  ///< [m]
inline constexpr UnitMixUp kApertureMixUp{0.009, 0.2, "mm"};
// From gases to cold oil; water has 1.8e-3 at the freezing point and 0.28e-3 at the boiling point.
inline constexpr Interval kViscosity{1e-6, 10};  ///< [Pa s]
inline constexpr UnitMixUp kViscosityMixUp{0.2, 10, "mPa s"};

inline constexpr std::array kFlowFields{
    NumberField<Flow>{"aperture", &Flow::aperture, "m", kHydraulicAperture, kApertureMixUp},
    NumberField<Flow>{"viscosity", &Flow::viscosity, "Pa s", kViscosity, kViscosityMixUp},
    NumberField<Flow>{"density", &Flow::density, "kg/m^3", kFluidDensity, kFluidDensityMixUp},
    NumberField<Flow>{"residual_aperture_share", &Flow::residual_share, "", Interval::positive(1)},
    NumberField<Flow>{"coupling_tolerance", &Flow::coupling_tolerance, "", Interval::positive(1)}};

/// Sections that hold nothing but such numbers, each with what holds them in the model: calls with its name,
/// its fields and that. The reader, overrides and units iterate over them.
template <class Each>
void eachNumberSection(const Each& each) {
    each("seismic", kSeismicFields, &Model::seismic);
    each("damping", kDampingFields, &Model::damping);
}

/// The keys, for a table's reader.
template <class Fields>
std::vector<std::string> keysOf(const Fields& fields) {
    std::vector<std::string> keys;
    for (const auto& field : fields) keys.emplace_back(field.key);
    return keys;
}

/// Puts what the table gives into `owner`, in SI units; the rest stays as it is.
template <class Fields, class Owner>
void readNumbers(TableReader& table, const Fields& fields, Owner& owner) {
    for (const auto& field : fields)
        if (const auto given = table.number(field.key, field.allowed, field.mix_up))
            owner.*field.value = *given * field.toSi();
}

/// `joint.NAME.KEY` taken apart.
struct JointField {
    std::string joint;  ///< "*": all
    std::string key;
};
std::optional<JointField> jointField(const FieldPath& path);

/// The unit a field's value has, by its name: "deg", "s", "Pa", ...; "" when it has none.
std::string unitOf(std::string_view field);

}  // namespace talus::formats::scenario
