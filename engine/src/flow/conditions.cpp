#include "flow/conditions.h"

#include <algorithm>
#include <cstdio>

#include "flow/places.h"
#include "model/gravity.h"

namespace talus::flow {
namespace {

class Places {
 public:
    Places(const Network& network, const Vec3& origin)
        : network_(network), origin_(origin), edges_(openEdges(network)) {}

    /// Calls with each node that a boundary takes, some of them several times. A boundary takes sides whose two
    /// ends are in its box. A node alone is no length for water to pass through: its discharge would be the mesh's.
    template <class Use>
    void each(const FlowBoundary& boundary, const Use& use) const {
        const auto isIn = [&](std::int32_t node) {
            return isInBox(network_.nodes[static_cast<std::size_t>(node)] + origin_, boundary.box_min,
                           boundary.box_max, kNear * network_.size);
        };
        const auto take = [&](std::int32_t from, std::int32_t to) {
            if (isIn(from) && isIn(to)) use(from), use(to);
        };
        if (!boundary.face) {
            for (std::size_t t = 0; t < network_.triangles.size(); ++t) {
                if (!takesJoint(boundary, network_.patch(t).joint)) continue;
                const auto [a, b, c] = network_.triangles[t];
                take(a, b), take(b, c), take(c, a);
            }
            return;
        }
        for (const OpenEdge& edge : edges_)
            if (takesJoint(boundary, network_.patch(edge.triangle).joint) &&
                takesFace(boundary, edge.outward))
                take(edge.nodes[0], edge.nodes[1]);
    }

 private:
    const Network& network_;
    Vec3 origin_;
    std::vector<OpenEdge> edges_;
};

std::string placeText(const Network& network, const Vec3& origin) {
    Vec3 low = Vec3::Constant(kInfinity), high = -low;
    for (const Vec3& x : network.nodes) low = low.cwiseMin(x + origin), high = high.cwiseMax(x + origin);
    std::array<char, 320> text{};
    std::snprintf(text.data(), text.size(), "x = %.3f to %.3f, y = %.3f to %.3f, z = %.3f to %.3f m", low.x(),
                  high.x(), low.y(), high.y(), low.z(), high.z());
    return text.data();
}

Error takesNothing(const FlowBoundary& boundary, const Network& network, const Vec3& origin) {
    const std::string what = boundary.face ? "open end of a joint" : "joint";
    return {boundary.field, "found no " + what +
                                " at this boundary; allowed: places of joints that bound a free block, in " +
                                placeText(network, origin)};
}

/// A head below all of its boundary would make that a drain, which the user has not asked for.
std::optional<Error> drains(const FlowBoundary& boundary, const Flow& flow, const Extent& places,
                            double rounding) {
    if (boundary.kind != FlowBoundary::Kind::head || !flow.free_surface ||
        boundary.head >= places.low - rounding)
        return std::nullopt;
    std::array<char, 240> text{};
    std::snprintf(text.data(), text.size(),
                  "found %.3f, below the whole of its boundary, which reaches from %.3f to %.3f m; "
                  "allowed: an elevation above the model's origin within or above these, or outlet = true",
                  boundary.head, places.low, places.high);
    return Error{boundary.field + ".head", text.data()};
}

/// Nodes of a head boundary above its head are outlets where there is a free surface.
void apply(const Flow& flow, std::size_t index, std::int32_t node, Conditions& to) {
    const auto n = static_cast<std::size_t>(node);
    if (to.boundary[n] >= 0) return;
    const FlowBoundary& boundary = flow.boundaries[index];
    const bool above = flow.free_surface && to.elevation[n] > boundary.head;
    to.boundary[n] = static_cast<std::int32_t>(index);
    if (boundary.kind == FlowBoundary::Kind::outlet || above) {
        to.of[n] = Condition::outlet;
        return;
    }
    to.of[n] = Condition::head;
    to.head[n] = boundary.head;
}

/// Parts of the network without a head are dry.
void leaveOutUnreached(const Network& network, Conditions& conditions) {
    const std::vector<std::int32_t> part = connectedParts(network);
    std::vector<char> reached(network.nodes.size(), 0);
    for (std::size_t n = 0; n < part.size(); ++n)
        if (conditions.of[n] == Condition::head) reached[static_cast<std::size_t>(part[n])] = 1;
    for (std::size_t n = 0; n < part.size(); ++n)
        if (reached[static_cast<std::size_t>(part[n])] == 0) conditions.of[n] = Condition::dry;
}

}  // namespace

Result<Conditions> conditionsOf(const Network& network, const Flow& flow, const Model& model,
                                const Vec3& origin, double tilt) {
    const std::size_t count = network.nodes.size();
    const Vec3 down = downward(model.gravity, tilt);
    Conditions conditions{std::vector(count, Condition::none), std::vector<std::int32_t>(count, -1),
                          std::vector<double>(count), std::vector<double>(count, 0.0)};
    for (std::size_t n = 0; n < count; ++n) conditions.elevation[n] = -down.dot(network.nodes[n] + origin);
    std::vector<Error> errors, drained;
    const Places places(network, origin);
    // A tilt that is searched for may raise a boundary above its head, which drains it; without any head left,
    // the network is dry.
    const bool is_own = tilt == model.gravity.tilt;
    for (std::size_t k = 0; k < flow.boundaries.size(); ++k) {
        Extent reached;
        places.each(flow.boundaries[k], [&](std::int32_t node) {
            reached.add(conditions.elevation[static_cast<std::size_t>(node)]);
            apply(flow, k, node, conditions);
        });
        if (model.is_remainder) continue;
        if (reached.high < reached.low)
            errors.push_back(takesNothing(flow.boundaries[k], network, origin));
        else if (auto fault = drains(flow.boundaries[k], flow, reached, kNear * network.size);
                 fault && is_own)
            drained.push_back(std::move(*fault));
    }
    const auto& of = conditions.of;
    const bool has_head = std::find(of.begin(), of.end(), Condition::head) != of.end();
    if (errors.empty() && !model.is_remainder && is_own && !has_head)
        errors.push_back({flow.field,
                          "found no place of the network with a head: every boundary lies above "
                          "its head; allowed: a head above the lowest place of its boundary"});
    errors.insert(errors.end(), drained.begin(), drained.end());
    if (!errors.empty()) return errors;
    leaveOutUnreached(network, conditions);
    return conditions;
}

}  // namespace talus::flow
