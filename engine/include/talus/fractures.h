#pragma once
// Discrete fracture networks: discs drawn at random, and how much of them lies in a region.

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "talus/result.h"
#include "talus/surface.h"

namespace talus {

/// A disc, or an ellipse.
struct Fracture {
    Vec3 centre = Vec3::Zero();  ///< [m]
    double dip = 0;              ///< [rad]
    double dip_direction = 0;    ///< clockwise from +y [rad]
    double radius = 0;           ///< of a disc; semi-major axis of an ellipse [m]
    double semi_minor = 0;       ///< of an ellipse, not above `radius`; 0: a disc [m]
    /// Of the major axis: its angle in the plane from the strike, downwards; the dip direction is 90 degrees
    /// clockwise of the strike [rad].
    double rake = 0;

    bool isEllipse() const { return semi_minor > 0; }
};

/// Unit vector along the major axis of an ellipse.
Vec3 majorAxis(const Fracture& ellipse);

/// Corners of a polygon that has as much area as the ellipse, in order.
std::vector<Vec3> outlineOf(const Fracture& ellipse);

enum class RadiusLaw : std::uint8_t {
    constant,   ///< `radius`
    lognormal,  ///< mean `radius`, standard deviation `deviation`; none beyond `least` and `most`
    power       ///< density r^-exponent from `least` to `most`
};

/// How discs are drawn: centres uniform in space, orientations by Fisher about the mean, radii by a law.
struct FractureSet {
    std::string name;
    double dip = 0;                ///< mean [rad]
    double dip_direction = 0;      ///< [rad]
    std::optional<double> fisher;  ///< Fisher constant; none: all parallel
    RadiusLaw law = RadiusLaw::constant;
    double radius = 0;     ///< [m]
    double deviation = 0;  ///< [m]
    double exponent = 0;
    double least = 0, most = 1e6;  ///< [m]
    /// Target area of discs inside the region over its volume [1/m]. Centres also lie outside, as far as
    /// discs reach, so that the intensity is the same near the surface. Only discs that reach into the region
    /// are kept.
    std::optional<double> p32;
    std::size_t count = 0;  ///< instead: number of discs with their centres inside the region
    std::int32_t joint = 0;
    std::string field{};  ///< "fracture_set[0]", for messages
};

/// Draws a set. The same seed, index of the set and region give the same discs. `p32` is reached within one
/// per cent: a disc that would go farther beyond it is drawn again. Errors: numbers out of range; more than a
/// million discs, before any is drawn; a target that such large discs cannot meet; a region that fills almost
/// none of its box; `stop`. \pre a sound surface
Result<std::vector<Fracture>> drawFractures(const FractureSet& set, const TriangleSurface& region,
                                            std::uint64_t seed, std::size_t index,
                                            const std::atomic<bool>* stop = nullptr);

/// Area of a disc or an ellipse inside a region [m^2], exactly.
double areaInside(const Fracture& disc, const TriangleSurface& region);

/// P32: area of discs inside a region over its volume [1/m].
double fractureIntensity(const std::vector<Fracture>& discs, const TriangleSurface& region);

/// Dip and dip direction of the plane with this normal [rad].
std::pair<double, double> dipOf(const Vec3& normal);

}  // namespace talus
