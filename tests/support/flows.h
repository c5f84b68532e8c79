#pragma once
// Models with steady flow in their joints, and what tests ask of the answer.

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "support/models.h"
#include "talus/flow.h"

namespace talus::test {

inline constexpr double kMobility = 1e-10;  ///< K / (rho g) of the networks below [m^2/(Pa s)]

/// Joints of this aperture, one a spacing, have the hydraulic conductivity K = kMobility rho g.
inline double apertureFor(double spacing, double viscosity = Flow{}.viscosity) {
    return std::cbrt(12 * viscosity * spacing * kMobility);
}

inline FlowBoundary headAt(const Vec3& face, double head) {
    FlowBoundary boundary;
    boundary.head = head;
    boundary.face = face;
    boundary.name = "head";
    boundary.field = "flow.boundary[0]";
    return boundary;
}

inline FlowBoundary outletAt(const Vec3& face) {
    FlowBoundary boundary = headAt(face, 0);
    boundary.kind = FlowBoundary::Kind::outlet;
    return boundary;
}

/// Heads at the two ends along x.
inline Flow flowAlongX(double aperture, double at_low_x, double at_high_x) {
    Flow flow;
    flow.aperture = aperture;
    flow.free_surface = false;
    flow.field = "flow";
    flow.boundaries = {headAt(-Vec3::UnitX(), at_low_x), headAt(Vec3::UnitX(), at_high_x)};
    return flow;
}

/// T = rho g b^3 / (12 mu) [m^2/s].
inline double cubicLaw(const Flow& flow, double aperture) {
    return flow.density * 9.81 * std::pow(aperture, 3) / (12 * flow.viscosity);
}

/// A dam of square blocks with its base on the floor. The joint at its base carries half of what the others
/// do, because the grid has half a spacing less rock there.
inline Model gridDam(int columns, int rows, int slices, const Vec3& size, double upstream,
                     double downstream) {
    Model model = stackModel(columns, rows, slices, 30, size);
    model.joints.push_back(joint(20));  // the joint with less friction counts
    model.joints[1].name = "base";
    model.blocks[0].face_joint.assign(6, 1);
    model.flow = flowAlongX(apertureFor(size.x()), upstream, downstream);
    model.flow->free_surface = true;
    model.flow->joint_apertures = {{1, model.flow->aperture / std::cbrt(2.0)}};
    return model;
}

/// Sum of the flows into the network at each node, over the whole inflow.
inline double largestImbalance(const SteadyFlow& flow) { return flow.imbalance / flow.inflow_sum; }

/// Whether any warning has this part.
inline bool says(const std::vector<std::string>& warnings, const char* part) {
    return std::any_of(warnings.begin(), warnings.end(),
                       [&](const std::string& warning) { return warning.find(part) != std::string::npos; });
}

}  // namespace talus::test
