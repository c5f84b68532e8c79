#pragma once
// A slope profile turned about the vertical, so that its face looks to a stated azimuth. Coordinates are
// turned, never given directions: x stays east, y north.

#include "talus/polyhedron.h"

namespace talus::formats::scenario {

class SlopeTurn {
 public:
    SlopeTurn() = default;
    /// \param azimuth_deg  to which the profile's lower side looks, clockwise from north
    /// \param faces_plus_x  that side is its +x side, else -x
    SlopeTurn(double azimuth_deg, bool faces_plus_x);

    bool isGiven() const { return is_given_; }
    bool isTurned() const { return sine_ != 0 || cosine_ != 1; }
    double azimuth() const { return azimuth_; }  ///< [rad]

    /// From the profile's axes to those of the model, about the origin.
    Vec3 operator()(const Vec3& p) const {
        return {p.x() * cosine_ - p.y() * sine_, p.x() * sine_ + p.y() * cosine_, p.z()};
    }

 private:
    double azimuth_ = 0, cosine_ = 1, sine_ = 0;  ///< of the angle from east to the profile's x
    bool is_given_ = false;
};

}  // namespace talus::formats::scenario
