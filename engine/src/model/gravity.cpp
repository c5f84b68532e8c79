#include "model/gravity.h"

#include <Eigen/Geometry>
#include <cmath>

namespace talus {
namespace {

/// About y, so that (0, 0, -1) becomes (-sin, 0, -cos).
Mat3 turnBy(double tilt) {
    const double s = std::sin(tilt), c = std::cos(tilt);
    Mat3 turn;
    turn << c, 0, s, 0, 1, 0, -s, 0, c;
    return turn;
}

/// Multiples of a right angle have no rounding, so that a push across a section stays in it.
double rounded(double component) { return std::abs(component) < 1e-15 ? 0.0 : component; }

}  // namespace

Mat3 compass(const Gravity& gravity, double tilt) {
    if (!gravity.direction) return turnBy(tilt);
    const Vec3 down = gravity.direction->normalized(), before = -Vec3::UnitZ();
    return turnBy(tilt) * Eigen::Quaterniond::FromTwoVectors(before, down).toRotationMatrix();
}

Vec3 downward(const Gravity& gravity, double tilt) {
    if (gravity.direction) return turnBy(tilt) * gravity.direction->normalized();
    return {-std::sin(tilt), 0.0, -std::cos(tilt)};
}

Vec3 pushOf(const Seismic& seismic, const Gravity& gravity, double tilt) {
    return compass(gravity, tilt) *
           Vec3(rounded(std::sin(seismic.azimuth)), rounded(std::cos(seismic.azimuth)), 0.0);
}

Vec3 seismicShare(const Seismic& seismic, double horizontal, const Gravity& gravity, double tilt) {
    return horizontal * pushOf(seismic, gravity, tilt) - seismic.vertical * downward(gravity, tilt);
}

}  // namespace talus
