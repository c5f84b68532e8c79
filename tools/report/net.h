#pragma once
// The stereonet: where a line plots on the lower hemisphere, and the curves drawn on it.

#include <cstdint>
#include <string>
#include <vector>

#include "report/svg_writer.h"
#include "talus/polyhedron.h"

namespace talus::tools {

enum class Projection : std::uint8_t {
    equal_area,  ///< Schmidt: r = sqrt(2) sin(t / 2), t the angle from vertical
    equal_angle  ///< Wulff: r = tan(t / 2)
};
const char* nameOf(Projection projection);  ///< "equal-area"

/// A net on the page, north upwards. Lines are unit vectors that point downwards; a plane's pole is minus its
/// upward normal.
class Net {
 public:
    Net(Spot middle, double radius, Projection projection)
        : middle_(middle), radius_(radius), projection_(projection) {}

    Spot middle() const { return middle_; }
    double radius() const { return radius_; }
    Projection projection() const { return projection_; }

    /// In the net's radius, x east and y north. Lines that point upwards plot outside the net.
    Spot onNet(const Vec3& line) const;
    Spot onPage(const Spot& on_net) const;
    Spot onPage(const Vec3& line) const { return onPage(onNet(line)); }
    Vec3 lineAt(const Spot& on_net) const;  ///< the inverse of onNet
    /// Of lines at this angle from vertical [rad], in the net's radius.
    double radiusOf(double angle) const;

    std::vector<Spot> greatCircle(const Vec3& normal) const;
    std::vector<Spot> cone(double angle) const;  ///< about the vertical [rad]

    /// Grid, frame and north; `words` stand below.
    void draw(SvgWriter& svg, const std::string& words) const;

 private:
    Spot middle_;
    double radius_;  ///< [px]
    Projection projection_;
};

}  // namespace talus::tools
