#pragma once
// Numbers drawn at random, the same on every machine.

#include <cmath>
#include <random>

namespace talus::test {

class Draw {
 public:
    explicit Draw(unsigned seed) : random_(seed) {}
    double between(double low, double high) {
        // The library's distributions differ between implementations.
        return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
    }
    /// As likely between 1 and 10 as between 10 and 100.
    double magnitude(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
    int one(int low, int high) { return low + static_cast<int>(random_() % unsigned(high - low + 1)); }

 private:
    std::mt19937_64 random_;
};

}  // namespace talus::test
