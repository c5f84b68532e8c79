#include "block_theory/group.h"

#include <algorithm>
#include <cmath>

namespace talus::keyblocks {
namespace {

/// Factors that differ by rounding alone become equal.
double rounded(const Group& group) { return std::round(group.sliding.factor * 1e9); }

}  // namespace

bool haveEqualFactors(const Group& a, const Group& b) { return rounded(a) == rounded(b); }

bool isBefore(const Group& a, const Group& b) {
    if (!haveEqualFactors(a, b)) return rounded(a) < rounded(b);
    const auto mass_a = static_cast<float>(a.mass), mass_b = static_cast<float>(b.mass);
    if (mass_a != mass_b) return mass_a > mass_b;
    return *std::min_element(a.members.begin(), a.members.end()) <
           *std::min_element(b.members.begin(), b.members.end());
}

}  // namespace talus::keyblocks
