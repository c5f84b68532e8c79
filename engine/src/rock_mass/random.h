#pragma once
// Random numbers that are the same on every machine, and for a plane of a joint set the same whatever the
// region.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "talus/polyhedron.h"

namespace talus::rock_mass {

/// SplitMix64 (G. L. Steele, D. Lea and C. H. Flood, 2014).
class Random {
 public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    /// A stream of its own for each plane of each set.
    Random(std::uint64_t seed, std::uint64_t set, std::int64_t plane) : state_(seed) {
        state_ = next() ^ (set + 1);
        state_ = next() ^ static_cast<std::uint64_t>(plane);
        next();
    }

    std::uint64_t next() {
        state_ += 0x9e3779b97f4a7c15ULL;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        return z ^ (z >> 31);
    }
    /// In [0, 1).
    double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

 private:
    std::uint64_t state_;
};

/// A direction scattered about `mean` (R. Fisher, 1953): cos of its angle from the mean has the density
/// exp(k cos), all turns about the mean alike.
inline Vec3 scattered(const Vec3& mean, double fisher, Random& random) {
    const double u = random.uniform(), turn = 2 * std::numbers::pi * random.uniform();
    const double cosine = std::max(-1.0, 1 + std::log(1 - u * (1 - std::exp(-2 * fisher))) / fisher);
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    const Vec3 side = mean.unitOrthogonal();
    const Vec3 normal = cosine * mean + sine * (std::cos(turn) * side + std::sin(turn) * mean.cross(side));
    return normal.z() < 0 ? Vec3(-normal) : normal;
}

}  // namespace talus::rock_mass
