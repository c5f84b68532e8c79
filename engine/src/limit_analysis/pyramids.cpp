#include "limit_analysis/pyramids.h"

#include <algorithm>
#include <cmath>

namespace talus::limit {
namespace {

constexpr double kTurn = 2 * M_PI;
constexpr int kFirstDirections = 4;  // of each pyramid at first
constexpr double kNearest = 1e-4;    // two directions [rad]

}  // namespace

Pyramids::Pyramids(const Assembly& assembly) : plane_section_(assembly.plane_section) {
    std::vector<double> first;
    const int directions = plane_section_ ? 2 : kFirstDirections;
    for (int k = 0; k < directions; ++k) first.push_back(kTurn * k / directions);
    angles_.assign(assembly.points.size(), first);
}

std::vector<Corner> Pyramids::corners(std::size_t point, Side side) const {
    const std::vector<double>& angles = angles_[point];
    std::vector<Corner> corners;
    for (std::size_t k = 0; k < angles.size(); ++k) {
        if (side == Side::inside || plane_section_) {
            corners.push_back({angles[k], 1.0});
            continue;
        }
        const double next = k + 1 < angles.size() ? angles[k + 1] : angles.front() + kTurn;
        const double half = 0.5 * (next - angles[k]);
        corners.push_back({angles[k] + half, 1 / std::cos(half)});
    }
    return corners;
}

bool Pyramids::add(std::size_t point, double angle) {
    std::vector<double>& angles = angles_[point];
    angle -= kTurn * std::floor(angle / kTurn);
    const auto after = std::lower_bound(angles.begin(), angles.end(), angle);
    const double next = after == angles.end() ? angles.front() + kTurn : *after;
    const double before = after == angles.begin() ? angles.back() - kTurn : *std::prev(after);
    if (plane_section_ || next - angle < kNearest || angle - before < kNearest) return false;
    angles.insert(after, angle);
    return true;
}

}  // namespace talus::limit
