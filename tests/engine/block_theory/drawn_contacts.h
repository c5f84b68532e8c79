#pragma once
// Contacts of a body whose planes are drawn, for tests of block theory.

#include <random>
#include <vector>

#include "block_theory/slope.h"

namespace talus::test {

inline Vec3 drawnDirection(std::mt19937& random) {
    std::normal_distribution<double> component;
    return Vec3(component(random), component(random), component(random)).normalized();
}

inline keyblocks::Contact contactWith(const Vec3& normal, double area = 1, std::int32_t joint = 0) {
    return {.other = 0, .joint = joint, .normal = normal.normalized(), .area = area};
}

inline std::vector<keyblocks::Contact> drawnContacts(std::mt19937& random, int count) {
    std::vector<keyblocks::Contact> contacts;
    for (int k = 0; k < count; ++k) contacts.push_back(contactWith(drawnDirection(random)));
    return contacts;
}

/// Upward normal of a plane [degrees].
inline Vec3 poleOf(double dip_deg, double dip_direction_deg) {
    const double dip = dip_deg * M_PI / 180, direction = dip_direction_deg * M_PI / 180;
    return {std::sin(dip) * std::sin(direction), std::sin(dip) * std::cos(direction), std::cos(dip)};
}

}  // namespace talus::test
