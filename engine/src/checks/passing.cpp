#include "checks/passing.h"

#include <algorithm>
#include <string>
#include <vector>

#include "contacts/deep_contacts.h"
#include "forces/contact_forces.h"
#include "geometry/thickness.h"
#include "measure/words.h"
#include "state/block_motion.h"
#include "state/incidence.h"
#include "state/placed_shape.h"
#include "state/point_layout.h"

namespace talus::checks {
namespace {

constexpr double kMostDepth = 0.5;  // of the thinner block's thickness: deeper, the far side is nearer
// Share of the smaller block's size below which no thickness is computed: a body of thin plates has a size of
// some three times theirs (smallestExtent).
constexpr double kLeastDepth = 0.1;
constexpr std::size_t kMostWarnings = 10;
constexpr const char* kFurther = "further pairs of blocks overlap by more than half of their thickness";

double sizeOf(const State& state, std::size_t i) {
    return std::min(state.geometry->size[static_cast<std::size_t>(state.interfaces.block_a[i])],
                    state.geometry->size[static_cast<std::size_t>(state.interfaces.block_b[i])]);
}

/// Whether an interface may be deep, without computing its position: its springs are pressed far, its
/// reference gap is far off, or it may have moved that far.
bool mayBeDeep(const State& state, std::size_t i, const std::vector<double>& ways) {
    const Interfaces& f = state.interfaces;
    // Share of the deepest corner's overlap: a triangular patch that just touches along its far side.
    constexpr double kMeanDepth = 1.0 / 3.0;
    const double least = kMeanDepth * kLeastDepth * sizeOf(state, i);
    if (-f.referenceGap(i, 0) > least) return true;
    const auto a = static_cast<std::size_t>(f.block_a[i]), b = static_cast<std::size_t>(f.block_b[i]);
    if (ways[a] + ways[b] > least) return true;
    // With restitution a parting contact has less force than in loading (unload, forces/contact_kernel.h).
    constexpr double kLeastForceShare = 0.01;
    const contact::JointLaw& law = state.laws[static_cast<std::size_t>(f.joint[i])];
    const double share = std::max(kLeastForceShare, 1 - law.unloading_loss);
    return contact::overlapFor(law, f.area[i], f.wrench(i).force.norm()) > share * least;
}

/// Thickness of the body of an interface's face, from a point of its surface inwards; of a convex one as a
/// whole [m].
double thickness(const State& state, std::int32_t block, std::int32_t face, const Vec3& surface,
                 const Vec3& inwards, double enough) {
    const auto b = static_cast<std::size_t>(block);
    const Geometry& geometry = *state.geometry;
    if (const auto body = partOfBody(state, partOf(geometry, block, face))) {
        const double within = thicknessAt(*body, surface, inwards, enough);
        return within > 0 ? within
                          : geometry.size[b];  // beside the body: a contact that has slid past its edge
    }
    const Vec3 own = state.blocks.orientation.matrix(b).transpose() * inwards;
    double low = kInfinity, high = -kInfinity;
    for (const Vec3& v : geometry.shape[b].vertices) {
        low = std::min(low, own.dot(v));
        high = std::max(high, own.dot(v));
    }
    return high - low;
}

struct Passing {
    std::int32_t thinner;
    double depth, thickness;  ///< [m]
};

std::string beginning(const State& state, std::size_t i) {
    const auto& blocks = state.geometry->model.blocks;
    const auto [first, second] = std::minmax(state.interfaces.block_a[i], state.interfaces.block_b[i]);
    return "blocks \"" + blocks[static_cast<std::size_t>(first)].name + "\" and \"" +
           blocks[static_cast<std::size_t>(second)].name + "\" overlap by ";
}

bool isWarned(const State& state, const std::string& begins) {
    return std::any_of(state.warnings.begin(), state.warnings.end(),
                       [&](const std::string& warning) { return warning.starts_with(begins); });
}

std::size_t warnedPairs(const State& state) {
    return static_cast<std::size_t>(
        std::count_if(state.warnings.begin(), state.warnings.end(), [](const std::string& warning) {
            return warning.starts_with("blocks \"") && warning.find("\" overlap by ") != std::string::npos;
        }));
}

void warn(State& state, std::size_t i, const Passing& passing) {
    const std::string begins = beginning(state, i);
    if (isWarned(state, begins)) return;
    const std::string when = " at t = " + formatted("%.6g", state.time) + " s";
    if (warnedPairs(state) >= kMostWarnings) {
        if (!isWarned(state, kFurther))
            state.warnings.push_back(std::string(kFurther) + ", the first" + when);
        return;
    }
    const std::string& name = state.geometry->model.blocks[static_cast<std::size_t>(passing.thinner)].name;
    state.warnings.push_back(
        begins + formatted("%.3g", passing.depth) + " m" + when + ", more than half of the thickness of \"" +
        name + "\" there, " + formatted("%.3g", passing.thickness) +
        " m: one may pass through the other. Make \"" + name + "\" thicker or normal_stiffness larger");
}

/// Of the deepest corner of a patch, whatever its gap is counted from [m].
double deepestCorner(const Interfaces& f, std::size_t i, const RelativePose& pose) {
    const double slope_1 = pose.gap.y() + f.referenceGap(i, 1), slope_2 = pose.gap.z() + f.referenceGap(i, 2);
    double deepest = depthOf(f, i, pose);
    for (const Eigen::Vector2d& v : patchOutline(f, i))
        deepest = std::max(deepest, depthOf(f, i, pose) - v.x() * slope_1 - v.y() * slope_2);
    return deepest;
}

/// At a contact that may be deep.
void look(State& state, std::size_t i) {
    const Interfaces& f = state.interfaces;
    const RelativePose pose = relativePose(state, i);
    const double depth = deepestCorner(f, i, pose);
    if (depth <= kLeastDepth * sizeOf(state, i)) return;
    const double enough = depth / kMostDepth;
    const double of_a = thickness(state, f.block_a[i], f.face_a[i], pose.origin, -pose.e3, enough),
                 of_b = thickness(state, f.block_b[i], f.face_b[i], pose.origin + pose.gap.x() * pose.e3,
                                  pose.e3, enough);
    if (depth <= kMostDepth * std::min(of_a, of_b)) return;
    warn(state, i, {of_a <= of_b ? f.block_a[i] : f.block_b[i], depth, std::min(of_a, of_b)});
}

}  // namespace

void warnOfPassing(State& state, double ahead) {
    std::vector<double> ways(state.blocks.size());
    for (std::size_t b = 0; b < ways.size(); ++b) ways[b] = ahead * speedBound(state, b);
    for (const InterfaceGroup& group : state.interfaces.groups) {
        if (group.is_idle) continue;
        for (std::int32_t k = 0; k < group.size; ++k) {
            const auto i = static_cast<std::size_t>(group.begin + k);
            if (!isIdle(state.interfaces, i) && mayBeDeep(state, i, ways)) look(state, i);
        }
    }
}

}  // namespace talus::checks
