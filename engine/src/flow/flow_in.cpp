#include "flow/flow_in.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <utility>

#include "flow/conditions.h"
#include "flow/equations.h"
#include "flow/meshing.h"
#include "flow/nested.h"

namespace talus {
namespace flow {
namespace {

constexpr double kLeak = 1e-3;      // of the largest inflow at a node
constexpr double kNothing = 1e-12;  // of the largest inflow at a node: rounding
constexpr double kSurface = 1e-6;   // of the median patch: nearer to zero a pressure head has no sign

double apertureOf(const Flow& flow, std::int32_t joint) {
    for (const auto& [of, aperture] : flow.joint_apertures)
        if (of == joint) return aperture;
    return flow.aperture;
}

std::string formatted(const char* format, double value) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), format, value);
    return text.data();
}

/// Of all boundaries.
std::string namesOf(const Flow& flow) {
    std::string names;
    for (const FlowBoundary& boundary : flow.boundaries)
        names += (names.empty() ? "given: \"" : ", \"") + boundary.name + "\"";
    return names;
}

bool isDry(const Network& network, const Conditions& conditions, std::size_t triangle) {
    return conditions.of[static_cast<std::size_t>(network.triangles[triangle][0])] == Condition::dry;
}

/// Numbers of the patches that no head reaches, ascending. Triangles of a patch follow each other.
std::vector<std::int32_t> unreachedPatches(const Network& network, const Conditions& conditions) {
    std::vector<std::int32_t> patches;
    for (std::size_t t = 0; t < network.triangles.size(); ++t)
        if (isDry(network, conditions, t) && (patches.empty() || patches.back() != network.patch_of[t]))
            patches.push_back(network.patch_of[t]);
    return patches;
}

std::optional<Error> doubtOf(const std::vector<std::int32_t>& unreached, const Network& network,
                             const Flow& flow, const Model& model) {
    if (unreached.empty()) return std::nullopt;
    const Patch& first = network.patches[static_cast<std::size_t>(unreached.front())];
    const auto name = [&](std::int32_t b) {
        return "\"" + model.blocks[static_cast<std::size_t>(b)].name + "\"";
    };
    return Error{flow.field, "no head reaches " + std::to_string(unreached.size()) + " of the " +
                                 std::to_string(network.patches.size()) +
                                 " polygons of joints, which are dry; the first lies between " +
                                 name(first.block_a) + " and " + name(first.block_b) + ", in joint \"" +
                                 model.joints[static_cast<std::size_t>(first.joint)].name + "\""};
}

/// Water enters at a head and can leave nowhere: it is the only boundary of each connected part that it
/// reaches. Where several have heads, still water may be meant.
std::vector<Error> sealedHeads(const Network& network, const Conditions& conditions, const Flow& flow) {
    const std::vector<std::int32_t> part = connectedParts(network);
    std::map<std::int32_t, std::set<std::int32_t>> boundaries_of;  // of each part
    for (std::size_t n = 0; n < part.size(); ++n)
        if (conditions.boundary[n] >= 0 && conditions.of[n] != Condition::dry)
            boundaries_of[part[n]].insert(conditions.boundary[n]);
    std::set<std::int32_t> sealed;
    for (const auto& [of, boundaries] : boundaries_of)
        if (boundaries.size() == 1) sealed.insert(*boundaries.begin());
    for (const auto& [of, boundaries] : boundaries_of)
        if (boundaries.size() > 1)
            for (const std::int32_t k : boundaries) sealed.erase(k);
    std::vector<Error> doubts;
    for (const std::int32_t k : sealed) {
        const FlowBoundary& boundary = flow.boundaries[static_cast<std::size_t>(k)];
        doubts.push_back({boundary.field,
                          "nothing drains the water of \"" + boundary.name + "\": no other boundary (" +
                              namesOf(flow) + ") lies on the joints that it reaches, where water stands at " +
                              formatted("%.4g", boundary.head) +
                              " m; without this warning: an outlet or another head where water leaves"});
    }
    return doubts;
}

/// Makes the result out of the heads.
class Answer {
 public:
    Answer(const State& state, const Flow& flow, const Network& network, const Conditions& conditions,
           const std::vector<Corners>& aperture)
        : model_(state.geometry->model),
          origin_(state.geometry->origin),
          flow_(flow),
          network_(network),
          conditions_(conditions),
          aperture_(aperture),
          unit_weight_(flow.density * model_.gravity.magnitude),
          transmissivity_(transmissivities(aperture, flow, unit_weight_)) {
        for (const Corners& b : aperture) into_.aperture.push_back((b[0] + b[1] + b[2]) / 3);
    }

    Result<SteadyFlow> solve(const Telling& telling) {
        Heads heads = nestedHeads(network_, conditions_, aperture_, flow_, unit_weight_, telling);
        if (!heads.found) return Error{flow_.field, faultOf(heads)};
        into_.ramp = heads.ramp;
        into_.iterations = heads.iterations;
        into_.residual = heads.residual;
        into_.head = std::move(heads.head);
        into_.inflow = std::move(heads.inflow);
        into_.wet_share = std::move(heads.wet_share);
        addNodes();
        addTriangles();
        addBoundaries();
        addSurface();
        warnOfParts();
        return std::move(into_);
    }

 private:
    std::string faultOf(const Heads& heads) const {
        const std::string tried = " after " + std::to_string(heads.iterations) +
                                  " iterations; the last one left " + formatted("%.2g", heads.residual) +
                                  " of the inflow unbalanced at a node; allowed: ";
        const auto [least, most] = std::ranges::minmax(into_.aperture);
        const std::string apertures = "apertures that differ less; the largest is " +
                                      formatted("%.3g", most / least) + " times the smallest";
        if (!flow_.free_surface) return "found no heads that balance the flow" + tried + apertures;
        const std::string finer = "a finer network (flow.refinements), or free_surface = false";
        return "found no free surface" + tried + finer + (most > least ? "; or " + apertures : "");
    }

    void addNodes() {
        for (std::size_t n = 0; n < network_.nodes.size(); ++n) {
            into_.nodes.push_back(network_.nodes[n] + origin_);
            const double above = into_.head[n] - conditions_.elevation[n];
            into_.pressure_head.push_back(std::isnan(above) ? 0.0 : above);
            const bool none = flow_.free_surface && above < 0;
            into_.pressure.push_back(none ? 0.0 : unit_weight_ * into_.pressure_head.back());
            if (conditions_.of[n] == Condition::none)
                into_.imbalance = std::max(into_.imbalance, std::abs(into_.inflow[n]));
        }
    }

    void addTriangles() {
        into_.triangles = network_.triangles;
        into_.patches = network_.patches.size();
        for (std::size_t t = 0; t < network_.triangles.size(); ++t) {
            const Patch& patch = network_.patch(t);
            into_.joint.push_back(patch.joint);
            into_.block_a.push_back(patch.block_a);
            into_.block_b.push_back(patch.block_b);
            into_.normal.push_back(patch.normal);
            into_.discharge.push_back(dischargeIn(t));
            if (isDry(t)) into_.wet_share[t] = 0;
        }
    }

    bool isDry(std::size_t t) const { return flow::isDry(network_, conditions_, t); }

    /// Per width of the joint: the flow along each side, over the triangle's area. With one aperture it is
    /// -T k grad h, because sum of c_ij (x_j - x_i)(x_j - x_i)^T is the area times the identity.
    Vec3 dischargeIn(std::size_t t) const {
        if (isDry(t)) return Vec3::Zero();
        const Gradients g = gradientsOf(network_, t);
        const Corners conductance = conductancesOf(g, transmissivity_[t]);
        const auto head = [&](std::size_t k) {
            return into_.head[static_cast<std::size_t>(network_.triangles[t][k])];
        };
        Vec3 flow = Vec3::Zero();
        for (std::size_t k = 0, next = 1; k < 3; ++k, next = (k + 1) % 3)
            flow +=
                conductance[k] * (head(k) - head(next)) * (network_.corner(t, next) - network_.corner(t, k));
        return into_.wet_share[t] / g.area * flow;
    }

    /// Inflow at the nodes of a boundary that are of one condition.
    struct Part {
        double net = 0;
        double highest_outflow = -kInfinity;
    };

    /// Only the sum over a boundary is a discharge: where triangles are obtuse, inflows of neighbouring nodes
    /// with one head differ in sign. Nodes in the dry part leak a little (solve.cpp); they count as no
    /// outflow.
    void addBoundaries() {
        for (const FlowBoundary& boundary : flow_.boundaries) into_.boundaries.push_back({boundary.name});
        const double most = into_.inflow.empty() ? 0 : *std::ranges::max_element(into_.inflow);
        std::vector<std::array<Part, 2>> parts(flow_.boundaries.size());  // of a head, of an outlet
        for (std::size_t n = 0; n < network_.nodes.size(); ++n) {
            if (conditions_.boundary[n] < 0 || conditions_.of[n] == Condition::dry) continue;
            const auto boundary = static_cast<std::size_t>(conditions_.boundary[n]);
            ++into_.boundaries[boundary].nodes;
            Part& part = parts[boundary][conditions_.of[n] == Condition::outlet ? 1 : 0];
            part.net += into_.inflow[n];
            if (into_.inflow[n] < -kLeak * most)
                part.highest_outflow = std::max(part.highest_outflow, conditions_.elevation[n]);
        }
        for (std::size_t k = 0; k < parts.size(); ++k)
            for (const Part& part : parts[k]) add(part, kNothing * most, into_.boundaries[k]);
    }

    void add(const Part& part, double nothing, BoundaryFlow& to) {
        if (std::abs(part.net) <= nothing) return;
        const double flow = std::abs(part.net);
        (part.net > 0 ? to.inflow : to.outflow) += flow;
        (part.net > 0 ? into_.inflow_sum : into_.outflow_sum) += flow;
        if (part.net < 0) to.highest_outflow = std::max(to.highest_outflow, part.highest_outflow);
    }

    /// Where the pressure passes through zero along the edges of the mesh.
    void addSurface() {
        if (!flow_.free_surface) return;
        std::map<std::pair<std::int32_t, std::int32_t>, bool> seen;
        into_.lowest_surface = kInfinity;
        into_.highest_surface = -kInfinity;
        for (std::size_t t = 0; t < network_.triangles.size(); ++t)
            for (std::size_t k = 0; k < 3 && !isDry(t); ++k) {
                const std::int32_t a = network_.triangles[t][k], b = network_.triangles[t][(k + 1) % 3];
                if (seen.try_emplace(std::minmax(a, b), true).second)
                    addCrossing(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
            }
        if (into_.free_surface.empty()) into_.lowest_surface = into_.highest_surface = 0;
    }

    void addCrossing(std::size_t a, std::size_t b) {
        const double above_a = into_.head[a] - conditions_.elevation[a],
                     above_b = into_.head[b] - conditions_.elevation[b];
        const double none = kSurface * network_.size;
        if (std::min(above_a, above_b) > -none || std::max(above_a, above_b) < none) return;
        const double place = above_a / (above_a - above_b);
        into_.free_surface.push_back(into_.nodes[a] + place * (into_.nodes[b] - into_.nodes[a]));
        const double height =
            conditions_.elevation[a] + place * (conditions_.elevation[b] - conditions_.elevation[a]);
        into_.lowest_surface = std::min(into_.lowest_surface, height);
        into_.highest_surface = std::max(into_.highest_surface, height);
    }

    void warnOfParts() {
        const std::vector<std::int32_t> unreached = unreachedPatches(network_, conditions_);
        into_.unreached_patches = unreached.size();
        if (const auto doubt = doubtOf(unreached, network_, flow_, model_))
            into_.warnings.push_back(doubt->field + ": " + doubt->message);
        for (const Error& doubt : sealedHeads(network_, conditions_, flow_))
            into_.warnings.push_back(doubt.field + ": " + doubt.message);
    }

    const Model& model_;
    Vec3 origin_;
    const Flow& flow_;
    const Network& network_;
    const Conditions& conditions_;
    const std::vector<Corners>& aperture_;
    double unit_weight_;                   ///< of water [N/m^3]
    std::vector<Corners> transmissivity_;  ///< of each triangle, along its sides [m^2/s]
    SteadyFlow into_;
};

}  // namespace

std::vector<Corners> statedApertures(const Network& network, const Flow& flow) {
    std::vector<Corners> apertures;
    for (std::size_t t = 0; t < network.triangles.size(); ++t) {
        const double b = apertureOf(flow, network.patch(t).joint);
        apertures.push_back({b, b, b});
    }
    return apertures;
}

Result<SteadyFlow> flowIn(const State& state, const Flow& flow, const Telling& telling) {
    const Model& model = state.geometry->model;
    const Network network = networkOf(state, flow.refinements, flow.boundaries);
    if (network.triangles.empty() && !model.is_remainder)
        return Error{flow.field,
                     "found no joint between two blocks that touch, one of them free; allowed: "
                     "flow in a model with joints"};
    return flowThrough({network, statedApertures(network, flow), model.gravity.tilt}, state, flow, telling);
}

Result<SteadyFlow> flowThrough(const Joints& joints, const State& state, const Flow& flow,
                               const Telling& telling) {
    const Geometry& geometry = *state.geometry;
    const auto conditions = conditionsOf(joints.network, flow, geometry.model, geometry.origin, joints.tilt);
    if (!conditions) return conditions.errors();
    return Answer(state, flow, joints.network, *conditions, joints.aperture).solve(telling);
}

std::vector<Error> doubtsOf(const State& state, const Flow& flow) {
    const Model& model = state.geometry->model;
    const Network network = networkOf(state, 0, flow.boundaries);
    const auto conditions = conditionsOf(network, flow, model, state.geometry->origin, model.gravity.tilt);
    if (!conditions) return {};
    std::vector<Error> doubts = sealedHeads(network, *conditions, flow);
    if (auto unreached = doubtOf(unreachedPatches(network, *conditions), network, flow, model))
        doubts.push_back(std::move(*unreached));
    return doubts;
}

}  // namespace flow

bool SteadyFlow::isWet(std::size_t triangle) const {
    return std::any_of(triangles[triangle].begin(), triangles[triangle].end(),
                       [&](std::int32_t n) { return pressure[static_cast<std::size_t>(n)] > 0; });
}

}  // namespace talus
