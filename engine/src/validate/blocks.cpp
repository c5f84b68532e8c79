#include <cmath>

#include "validate/findings.h"

namespace talus {
namespace {

constexpr double kUnit = 1e-9;  // how far the square of a quaternion may be from 1

bool isSized(const VectorArray& array, std::size_t n) {
    return array.x.size() == n && array.y.size() == n && array.z.size() == n;
}

bool areSized(const Blocks& blocks) {
    const std::size_t n = blocks.size();
    for (const VectorArray* array :
         {&blocks.velocity, &blocks.angular_momentum, &blocks.force, &blocks.torque, &blocks.angular_velocity,
          &blocks.inertia, &blocks.inverse_inertia})
        if (!isSized(*array, n)) return false;
    return blocks.position.size() == n && blocks.orientation.size() == n && blocks.inverse_mass.size() == n &&
           blocks.motion.size() == n && blocks.free.size() == n;
}

bool areSized(const Geometry& geometry, std::size_t n) {
    return geometry.shape.size() == n && geometry.size.size() == n && geometry.radius.size() == n &&
           geometry.face_area.size() == n && geometry.first_part.size() == n + 1 &&
           geometry.initial_position.size() == n && geometry.initial_orientation.size() == n &&
           geometry.model.blocks.size() == n;
}

bool isUnit(const Quaternion& q) {
    return std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1.0) < kUnit;
}

/// Free blocks have inertia, the others none, as no force moves them.
bool hasFittingInertia(const Blocks& blocks, std::size_t b) {
    const Vec3 inverse = blocks.inverse_inertia.get(b);
    if (blocks.motion[b] == Motion::free) return blocks.inverse_mass[b] > 0 && inverse.minCoeff() > 0;
    return blocks.inverse_mass[b] == 0 && inverse.isZero(0);
}

void checkBlock(const State& state, std::size_t b, Findings& findings) {
    const Blocks& blocks = state.blocks;
    const Geometry& geometry = *state.geometry;
    findings.expect(isUnit(blocks.orientation[b]) && isUnit(geometry.initial_orientation[b]), "block", b,
                    "its quaternion is not a unit one");
    findings.expect(blocks.mass[b] > 0 && blocks.inertia.get(b).minCoeff() > 0, "block", b,
                    "its mass or a moment of inertia is not positive");
    findings.expect((blocks.free[b] != 0) == (blocks.motion[b] == Motion::free), "block", b,
                    "the kernels take it for free and it is not, or the other way round");
    findings.expect(hasFittingInertia(blocks, b), "block", b,
                    "the inertia used in its motion does not suit it");
    findings.expect(geometry.size[b] > 0 && geometry.radius[b] > 0 && geometry.face_area[b] > 0, "block", b,
                    "its size, radius or mean face area is not positive");
}

}  // namespace

void checkBlocks(const State& state, Findings& findings) {
    const std::size_t n = state.blocks.size();
    findings.expect(areSized(state.blocks), "arrays of blocks differ in size");
    findings.expect(areSized(*state.geometry, n), "there are not as many shapes as blocks");
    findings.expect(state.laws.size() >= state.geometry->model.joints.size(),
                    "there are fewer laws than joints");
    findings.expect(state.search_position.size() == n && state.search_orientation.size() == n,
                    "the last search has not the poses of all blocks");
    findings.expect(state.search_margin > 0, "the last search had no margin");
    if (!findings.none()) return;
    for (std::size_t b = 0; b < n; ++b) checkBlock(state, b, findings);
}

}  // namespace talus
