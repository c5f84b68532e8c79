#include "slope.h"

#include <malloc.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "build/build.h"
#include "counts.h"
#include "process.h"
#include "step/step.h"
#include "step/time_step.h"

namespace talus::bench {
namespace {

constexpr double kDegree = M_PI / 180.0;
const Vec3 kBlock{0.2, 0.1, 0.1};

struct Shape {
    int columns, rows, slices;
};

Shape shapeOf(int blocks) {
    switch (blocks) {
        case 105:
            return {7, 5, 3};  // the paper's
        case 1000:
            return {10, 10, 10};
        case 10000:
            return {25, 20, 20};
        case 100000:
            return {50, 50, 40};
        default:
            return {100, 100, 100};
    }
}

Joint paperJoint(double friction_deg) {
    Joint joint;
    joint.name = "default";
    joint.normal_stiffness = joint.shear_stiffness = 3.375e11;
    joint.friction = joint.residual_friction = friction_deg * kDegree;
    return joint;
}

Block boxBlock(std::string name, const Vec3& min, const Vec3& max, Motion motion, std::int32_t joint) {
    Block block;
    block.name = std::move(name);
    block.shape = *makeBox(min, max);
    block.density = 2700;
    block.motion = motion;
    block.face_joint.assign(block.shape.faces.size(), joint);
    return block;
}

/// Water half way up the joint behind the first column.
Water fissure(const Shape& shape) {
    constexpr std::int32_t kMinusX = 0, kPlusX = 1;  // faces of makeBox
    Water water;
    water.level = {{0.0, 0.5 * shape.rows * kBlock.z()}};
    water.base = 0.0;
    const int per_column = shape.rows * shape.slices;
    for (std::int32_t b = 0; b < 2 * per_column; ++b)
        water.walls.push_back({1 + b, b < per_column ? kPlusX : kMinusX});
    water.field = "water[0]";
    return water;
}

std::vector<Joint> jointsOf(Filling filling) {
    if (filling == Filling::mixed) return {paperJoint(19.5), paperJoint(25), paperJoint(30), paperJoint(35)};
    std::vector<Joint> joints{paperJoint(19.5)};
    if (filling == Filling::cohesion) {
        joints[0].cohesion = 5000;
        joints[0].tensile_strength = 500;
    }
    if (filling == Filling::rough) {  // some 20 degrees at the stresses of these slopes
        joints[0].law = StrengthLaw::barton_bandis;
        joints[0].jrc = 3;
        joints[0].jcs = 5e7;
        joints[0].residual_friction = 7 * kDegree;
    }
    return joints;
}

/// Under its weight, at rest as far as so many steps get: all that big slopes need is that no contact point
/// is idle.
void settle(Slope& slope) {
    constexpr double kPointSteps = 2e7;
    constexpr int kMost = 4000;
    State& state = slope.state;
    const auto bounds = frequencyBounds(state, true);
    slope.time_step = 0.6 * stableTimeStep(*std::max_element(bounds.begin(), bounds.end()), 0.0);
    state.damping.local = 0.7;
    updateForces(state, true);
    const int steps =
        std::clamp(static_cast<int>(kPointSteps / static_cast<double>(slope.points())), 5, kMost);
    advance(state, {slope.time_step, true}, steps);
    state.damping.local = 0.3;
}

}  // namespace

const char* toString(Filling filling) {
    constexpr std::array<const char*, 5> kNames{"", "+water", "+cohesion", "+mixed", "+rough"};
    return kNames[static_cast<std::size_t>(filling)];
}

std::string SlopeKind::name() const {
    return nameOf(points) + toString(filling) + "/" + std::to_string(blocks);
}

Model makeSlope(const SlopeKind& kind) {
    const Shape shape = shapeOf(kind.blocks);
    Model model;
    model.joints = jointsOf(kind.filling);
    model.points = kind.points;
    model.gravity.tilt = 15 * kDegree;
    const Vec3 extent{shape.columns * kBlock.x(), shape.slices * kBlock.y(), shape.rows * kBlock.z()};
    model.blocks.reserve(static_cast<std::size_t>(kind.blocks) + 1);
    model.blocks.push_back(boxBlock("floor", {-1, -1, -1}, {extent.x() + 1, extent.y() + 1, 0}, Motion::fixed,
                                    static_cast<std::int32_t>(model.joints.size()) - 1));
    for (int c = 0; c < shape.columns; ++c)
        for (int r = 0; r < shape.rows; ++r)
            for (int s = 0; s < shape.slices; ++s) {
                const Vec3 min{c * kBlock.x(), s * kBlock.y(), r * kBlock.z()};
                const Vec3 max{(c + 1) * kBlock.x(), (s + 1) * kBlock.y(), (r + 1) * kBlock.z()};
                const auto joint =
                    static_cast<std::int32_t>(static_cast<std::size_t>(c + r + s) % model.joints.size());
                model.blocks.push_back(boxBlock(
                    "c" + std::to_string(c + 1) + "r" + std::to_string(r + 1) + "s" + std::to_string(s + 1),
                    min, max, Motion::free, joint));
            }
    if (kind.filling == Filling::water) model.waters = {fissure(shape)};
    return model;
}

Slope buildSlope(const SlopeKind& kind) {
    Slope slope;
    slope.kind = kind;
    malloc_trim(0);
    resetPeakMemory();
    const double before = residentBytes();
    {
        const double start = wallSeconds();
        Model model = makeSlope(kind);
        const double made = wallSeconds(), cpu = processSeconds();
        slope.state = *buildState(std::move(model), true);
        slope.model_seconds = made - start;
        slope.build_seconds = wallSeconds() - made;
        slope.build_cpu = processSeconds() - cpu;
    }
    slope.peak_bytes = peakBytes();
    malloc_trim(0);
    slope.state_bytes = residentBytes() - before;
    settle(slope);
    slope.start = {slope.state.blocks, slope.state.points};
    return slope;
}

Slope& slopeFor(const SlopeKind& kind) {
    static std::optional<Slope> last;
    if (!last || last->kind.name() != kind.name()) {
        last.reset();
        last = buildSlope(kind);
    }
    last->state.blocks = last->start.blocks;
    last->state.points = last->start.points;
    return *last;
}

}  // namespace talus::bench
