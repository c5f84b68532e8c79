#pragma once
// Random numbers that are the same on every machine, and for a plane of a joint set the same whatever the region.

#include <cmath>
#include <cstdint>

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

}  // namespace talus::rock_mass
