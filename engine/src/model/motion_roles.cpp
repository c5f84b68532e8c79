#include "talus/motion_roles.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus {
namespace {

/// Diagonal of the box around the moving blocks: it makes a rotation comparable with a translation. A block
/// that turns about a pivot within reach of the moving group topples; one whose pivot is far away slides.
double movingExtent(const std::vector<BlockDisplacement>& blocks, const std::vector<char>& moving) {
    constexpr double kUnbounded = std::numeric_limits<double>::infinity();
    Vec3 low = Vec3::Constant(kUnbounded), high = Vec3::Constant(-kUnbounded);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (!moving[b]) continue;
        const Vec3 reach = Vec3::Constant(blocks[b].radius);
        low = low.cwiseMin(blocks[b].position - reach);
        high = high.cwiseMax(blocks[b].position + reach);
    }
    return (high - low).norm();
}

}  // namespace

double BlockDisplacement::tipping() const {
    return std::sqrt(std::max(rotation * rotation - spin * spin, 0.0));
}

std::vector<FailureMode> motionRoles(const std::vector<BlockDisplacement>& blocks, double deflection) {
    double farthest = 0;
    for (const BlockDisplacement& block : blocks)
        if (block.free) farthest = std::max(farthest, block.ofFarthestCorner());
    const double least = std::max(MotionRule::kDeflections * deflection, MotionRule::kShare * farthest);
    std::vector<char> moving(blocks.size(), 0);
    for (std::size_t b = 0; b < blocks.size(); ++b)
        moving[b] = blocks[b].free && blocks[b].ofFarthestCorner() > least;
    const double extent = movingExtent(blocks, moving);
    std::vector<FailureMode> roles(blocks.size(), FailureMode::none);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (!moving[b]) continue;
        const bool has_pivot =
            blocks[b].least_against_others < MotionRule::kNoPivot * blocks[b].ofFarthestCorner();
        const bool topples =
            has_pivot && blocks[b].tipping() * extent > MotionRule::kToppling * blocks[b].ofFarthestCorner();
        roles[b] = topples ? FailureMode::toppling : FailureMode::sliding;
    }
    return roles;
}

FailureMode overallMode(const std::vector<BlockDisplacement>& blocks, const std::vector<FailureMode>& roles) {
    double sliding = 0, toppling = 0;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (roles[b] == FailureMode::sliding) sliding += blocks[b].mass;
        if (roles[b] == FailureMode::toppling) toppling += blocks[b].mass;
    }
    const double all = sliding + toppling;
    if (all == 0) return FailureMode::none;
    if (sliding >= MotionRule::kPure * all) return FailureMode::sliding;
    return toppling >= MotionRule::kPure * all ? FailureMode::toppling : FailureMode::mixed;
}

}  // namespace talus
