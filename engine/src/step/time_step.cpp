#include "step/time_step.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "forces/contact_forces.h"
#include "forces/sum.h"
#include "law/points.h"
#include "state/incidence.h"
#include "state/range.h"

namespace talus {
namespace {

using Mat6 = Eigen::Matrix<double, 6, 6>;

/// Adds the stiffness of a spring on a block at an arm from its centroid, without the lower left block.
void addSpring(const Mat3& k, const Vec3& arm, Mat6& sum) {
    const double x = arm.x(), y = arm.y(), z = arm.z();
    // u = v + C theta, with the columns (0, -z, y), (z, 0, -x), (-y, x, 0) of C.
    const auto times_c = [&](const Mat3& m) {
        Mat3 mc;
        mc.col(0) = m.col(2) * y - m.col(1) * z;
        mc.col(1) = m.col(0) * z - m.col(2) * x;
        mc.col(2) = m.col(1) * x - m.col(0) * y;
        return mc;
    };
    sum.topLeftCorner<3, 3>() += k;
    sum.topRightCorner<3, 3>() += times_c(k);
    sum.bottomRightCorner<3, 3>() += times_c(times_c(k.transpose()).transpose());
}

/// Stiffness that one interface gives a block whose centroid is `centre`, its neighbour held.
Mat6 interfaceStiffness(const State& state, std::size_t i, const Vec3& centre) {
    const RelativePose pose = relativePose(state, i);
    const contact::StiffnessOf<double> law =
        contact::stiffnessOf(state.laws[static_cast<std::size_t>(state.interfaces.joint[i])]);
    Mat3 stiffness = law.shear * (pose.e1 * pose.e1.transpose() + pose.e2 * pose.e2.transpose()) +
                     law.normal * pose.e3 * pose.e3.transpose();
    Mat6 sum = Mat6::Zero();
    for (const contact::PatchPoint& point :
         interfacePoints(state.interfaces, i, state.geometry->model.points)) {
        const Vec3 arm = pose.origin + point.position.x() * pose.e1 + point.position.y() * pose.e2 - centre;
        addSpring(point.area * stiffness, arm, sum);
    }
    sum.bottomLeftCorner<3, 3>() = sum.topRightCorner<3, 3>().transpose();
    return sum;
}

/// Stiffness of ties on a block, counted twice against a block that moves.
Mat6 tieStiffness(const State& state, std::size_t block) {
    Mat6 sum = Mat6::Zero();
    eachBlockForce(state, [&](const BlockForce& force, const ForceParts& parts) {
        if (force.tying == nullptr || force.blocks(state, parts).empty()) return;
        for (const auto& [other, spring] : force.tying->springsOn(state, parts, block)) {
            const double share =
                state.blocks.motion[static_cast<std::size_t>(other)] == Motion::free ? 2.0 : 1.0;
            addSpring(share * spring.stiffness, spring.place - state.blocks.position.get(block), sum);
        }
    });
    sum.bottomLeftCorner<3, 3>() = sum.topRightCorner<3, 3>().transpose();
    return sum;
}

/// For an area that may close anywhere on a block with the stiffest joint:
/// lambda_max <= trace of M^-1 K <= k A (3 / m + 3 r^2 / I_min).
double boundAnywhere(const State& state, std::size_t block, double area) {
    double stiffness = 0;
    for (const contact::JointLaw& law : state.laws)
        stiffness = std::max(stiffness, contact::largestStiffness(law));
    const double r = state.geometry->radius[block];
    return stiffness * area *
           (3.0 / state.blocks.mass[block] + 3.0 * r * r / state.blocks.inertia.get(block).minCoeff());
}

/// For a block of several parts half the surface, as it can touch on one side only; else the largest face
/// [m^2].
double largestSide(const Polyhedron& shape) {
    double largest = 0, surface = 0;
    for (std::size_t f = 0; f < shape.faces.size(); ++f) {
        if (shape.isInner(f)) continue;
        const double area = shape.faceArea(f);
        largest = std::max(largest, area);
        surface += area;
    }
    return shape.partCount() == 1 ? largest : 0.5 * surface;
}

/// Bound for the first contact of a block in the air: its largest side.
double boundInTheAir(const State& state, std::size_t block) {
    return boundAnywhere(state, block, largestSide(state.geometry->shape[block]));
}

double frequencyBound(const State& state, std::size_t block) {
    const Blocks& blocks = state.blocks;
    const Incidence& incidence = state.incidence;
    const auto begin = incidence.interface_begin[block], end = incidence.interface_begin[block + 1];
    if (blocks.motion[block] != Motion::free) return 0.0;
    Mat6 stiffness = Mat6::Zero();
    double idle_area = 0;  // of vertices and edges that may touch before the next call
    bool touches_nothing = true;
    for (auto k = begin; k < end; ++k) {
        const auto i = static_cast<std::size_t>(incidence.interface[static_cast<std::size_t>(k)]);
        if (isIdle(state.interfaces, i)) {
            idle_area += 2.0 * state.interfaces.area[i];
            continue;
        }
        touches_nothing = false;
        const bool is_b = incidence.isB(k);
        const auto other =
            static_cast<std::size_t>(is_b ? state.interfaces.block_a[i] : state.interfaces.block_b[i]);
        const double share = blocks.motion[other] == Motion::free ? 2.0 : 1.0;
        stiffness += share * interfaceStiffness(state, i, blocks.position.get(block));
    }
    const double in_the_air = touches_nothing ? boundInTheAir(state, block) : 0.0;
    stiffness += tieStiffness(state, block);
    // M^-1/2 K M^-1/2, the rotations in the block's own frame where the inertia is diagonal.
    const Mat3 turn = blocks.orientation.matrix(block);
    Mat6 to_own = Mat6::Zero();
    to_own.topLeftCorner<3, 3>() = Mat3::Identity() / std::sqrt(blocks.mass[block]);
    to_own.bottomRightCorner<3, 3>() =
        turn * blocks.inertia.get(block).cwiseSqrt().cwiseInverse().asDiagonal();
    const Mat6 scaled = to_own.transpose() * stiffness * to_own;
    const double closed =
        Eigen::SelfAdjointEigenSolver<Mat6>(scaled, Eigen::EigenvaluesOnly).eigenvalues()[5];
    if (touches_nothing) return in_the_air + closed;
    return idle_area > 0 ? closed + boundAnywhere(state, block, idle_area) : closed;
}

}  // namespace

std::vector<double> frequencyBounds(const State& state, bool parallel) {
    std::vector<double> bounds(state.blocks.size());
    forRange(bounds.size(), 256, parallel, [&](Range range) {
        for (std::size_t b = range.begin; b < range.end; ++b) bounds[b] = frequencyBound(state, b);
    });
    return bounds;
}

double highestFrequency(const State& state, bool parallel) {
    const std::vector<double> bounds = frequencyBounds(state, parallel);
    return *std::max_element(bounds.begin(), bounds.end());
}

double medianBound(std::vector<double> bounds) {
    std::erase_if(bounds, [](double bound) { return !(bound > 0); });
    if (bounds.empty()) return 0.0;
    const auto middle = bounds.begin() + static_cast<std::ptrdiff_t>((bounds.size() - 1) / 2);
    std::nth_element(bounds.begin(), middle, bounds.end());
    return *middle;
}

double stableTimeStep(double omega_squared, double contact_damping) {
    const double omega = std::sqrt(omega_squared);
    const double xi = 0.5 * contact_damping * omega;
    return 2.0 / omega * (std::sqrt(1.0 + xi * xi) - xi);
}

double frequencyOfStep(double time_step, double contact_damping) {
    return 4.0 / (time_step * (time_step + 2.0 * contact_damping));
}

}  // namespace talus
