#include "flow/meshing.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "flow/delaunay.h"
#include "flow/footprints.h"
#include "flow/grading.h"
#include "geometry/box_tree.h"
#include "model/gravity.h"
#include "state/closed_gap.h"
#include "state/point_layout.h"

namespace talus::flow {
namespace {

// Of the size of a patch's smaller block: corners of patches that are closer together are one node. Faces touch
// across gaps of kClosedGap. Where two such gaps cross, corners lie within sqrt(2) kClosedGap.
constexpr double kSameNode = 2 * kClosedGap;  // of the smaller block of a patch
constexpr double kRoundedNode = 1e-5;         // of the median block: at least. Outlines are rounded to 1e-9

constexpr double kInPlane = 1 - 1e-6;  // cosine: a face of a block so near to parallel is the joint's own

constexpr double kLevel = 1e-6;  // of the median patch: a network of less height is level

struct Outline {
    Vec3 centre;
    std::vector<Vec3> corners;
    double same = 0;  ///< distance within which another corner is the same node [m]
};

double smallerSize(const State& state, std::size_t interface) {
    const auto sizeOf = [&](std::int32_t b) { return state.geometry->size[static_cast<std::size_t>(b)]; };
    return std::min(sizeOf(state.interfaces.block_a[interface]), sizeOf(state.interfaces.block_b[interface]));
}

/// A patch in the state's coordinates, as its blocks stood at the start.
Outline outlineOf(const State& state, std::size_t interface) {
    const Geometry& geometry = *state.geometry;
    const InterfaceFrame frame = state.interfaces.frame(interface);
    const auto a = static_cast<std::size_t>(state.interfaces.block_a[interface]);
    const Mat3 turn = geometry.initial_orientation.matrix(a);
    const Vec3 position = geometry.initial_position.get(a);
    const auto placed = [&](const Vec2& v) -> Vec3 {
        return position + turn * (frame.origin_a + v.x() * frame.e1_a + v.y() * frame.e2_a);
    };
    Outline outline{placed(Vec2::Zero()), {}};
    for (const Vec2& corner : patchOutline(state.interfaces, interface))
        outline.corners.push_back(placed(corner));
    outline.same = std::max(kRoundedNode * geometry.length_scale, kSameNode * smallerSize(state, interface));
    return outline;
}

Patch patchOf(const State& state, std::size_t interface) {
    const Interfaces& f = state.interfaces;
    const InterfaceFrame frame = f.frame(interface);
    const auto a = static_cast<std::size_t>(f.block_a[interface]);
    const Mat3 turn = state.geometry->initial_orientation.matrix(a);
    return {static_cast<std::int32_t>(interface), f.block_a[interface], f.block_b[interface],
            f.joint[interface], turn * frame.e1_a.cross(frame.e2_a)};
}

/// Least distance between the two faces over the patch, as the blocks stood at the start [m].
double leastGap(const State& state, std::size_t interface) {
    const Geometry& geometry = *state.geometry;
    const InterfaceFrame frame = state.interfaces.frame(interface);
    const auto a = static_cast<std::size_t>(state.interfaces.block_a[interface]),
               b = static_cast<std::size_t>(state.interfaces.block_b[interface]);
    const Mat3 turn_a = geometry.initial_orientation.matrix(a),
               turn_b = geometry.initial_orientation.matrix(b);
    const Vec3 apart = geometry.initial_position.get(b) - geometry.initial_position.get(a);
    const Vec3 normal = turn_a * frame.e1_a.cross(frame.e2_a);
    double least = kInfinity;
    for (const Vec2& v : patchOutline(state.interfaces, interface)) {
        const Vec3 on_a = turn_a * (frame.origin_a + v.x() * frame.e1_a + v.y() * frame.e2_a);
        const Vec3 on_b = apart + turn_b * (frame.origin_b + v.x() * frame.e1_b + v.y() * frame.e2_b);
        least = std::min(least, normal.dot(on_b - on_a));
    }
    return least;
}

/// Faces that the contact search found because they are near, but that do not touch, are no joint.
bool isJoint(const State& state, std::size_t interface) {
    return state.interfaces.kind[interface] == InterfaceKind::faces &&
           leastGap(state, interface) <= kClosedGap * smallerSize(state, interface);
}

void addFacesBeside(const State& state, std::int32_t block, const Vec3& normal, std::vector<RockFace>& to) {
    const Geometry& geometry = *state.geometry;
    const auto b = static_cast<std::size_t>(block);
    const Mat3 turn = geometry.initial_orientation.matrix(b);
    const Polyhedron& shape = geometry.shape[b];
    for (std::size_t f = 0; f < shape.faces.size(); ++f) {
        const FacePlane& plane = geometry.face_planes[geometry.first_plane[b] + f];
        const Vec3 out = turn * plane.normal;
        if (shape.isInner(f) || std::abs(out.dot(normal)) > kInPlane) continue;
        to.push_back({out, out.dot(geometry.initial_position.get(b) + turn * plane.at)});
    }
}

std::vector<RockFace> facesBeside(const State& state, const Patch& patch) {
    std::vector<RockFace> faces;
    for (const std::int32_t block : {patch.block_a, patch.block_b})
        addFacesBeside(state, block, patch.normal, faces);
    return faces;
}

Box boxAround(const Vec3& point, double margin) {
    Box box;
    box.add(point);
    return box.grown(margin);
}

struct Corner {
    Vec3 place;
    double same;  ///< [m]
};

/// Which node each corner is: those near a node's first corner are that node.
/// \param reach  of each node, the largest distance within which a corner is the same [m]
std::vector<std::int32_t> merged(const std::vector<Corner>& corners, std::vector<Vec3>& nodes,
                                 std::vector<double>& reach) {
    std::vector<Box> boxes;
    double widest = 0;
    for (const Corner& corner : corners) {
        boxes.push_back(boxAround(corner.place, 0));
        widest = std::max(widest, corner.same);
    }
    const BoxTree tree(std::move(boxes));
    std::vector<std::int32_t> node(corners.size(), -1);
    for (std::size_t c = 0; c < corners.size(); ++c) {
        if (node[c] >= 0) continue;
        const auto next = static_cast<std::int32_t>(nodes.size());
        nodes.push_back(corners[c].place);
        reach.push_back(corners[c].same);
        tree.visit(boxAround(corners[c].place, widest), [&](std::size_t other) {
            const double same = std::max(corners[c].same, corners[other].same);
            if (node[other] >= 0 || (corners[other].place - corners[c].place).norm() > same) return;
            node[other] = next;
            reach.back() = std::max(reach.back(), same);
        });
    }
    return node;
}

/// Makes the fans of all patches.
class Fans {
 public:
    Fans(const State& state, Network& network) : state_(state), network_(network) {
        for (std::size_t i = 0; i < state.interfaces.size(); ++i) {
            if (!isJoint(state, i)) continue;
            outlines_.push_back(outlineOf(state, i));
            patches_.push_back(patchOf(state, i));
        }
    }

    void make() {
        std::vector<Corner> corners;
        for (const Outline& outline : outlines_)
            for (const Vec3& corner : outline.corners) corners.push_back({corner, outline.same});
        const std::vector<std::int32_t> node = merged(corners, network_.nodes, reach_);
        if (!reach_.empty()) widest_ = *std::max_element(reach_.begin(), reach_.end());
        std::vector<Box> boxes;
        for (const Vec3& x : network_.nodes) boxes.push_back(boxAround(x, 0));
        tree_ = BoxTree(std::move(boxes));
        std::size_t first = 0;
        for (std::size_t p = 0; p < patches_.size(); ++p) {
            const std::size_t count = outlines_[p].corners.size();
            add(p, std::vector(node.begin() + static_cast<std::ptrdiff_t>(first),
                               node.begin() + static_cast<std::ptrdiff_t>(first + count)));
            first += count;
        }
    }

 private:
    /// The outline with the nodes that other patches have on it, each node once.
    std::vector<std::int32_t> ringOf(const std::vector<std::int32_t>& corners, double same) const {
        std::vector<std::int32_t> ring;
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const std::int32_t from = corners[k], to = corners[(k + 1) % corners.size()];
            if (from == to) continue;
            ring.push_back(from);
            for (const std::int32_t node : between(from, to, same))
                if (!contains(corners, node) && !contains(ring, node)) ring.push_back(node);
        }
        return ring;
    }

    static bool contains(const std::vector<std::int32_t>& nodes, std::int32_t node) {
        return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
    }

    /// Nodes on an edge, in its direction.
    std::vector<std::int32_t> between(std::int32_t from, std::int32_t to, double same) const {
        const Vec3 &begin = at(from), along = at(to) - begin;
        const double length = along.norm();
        Box box = boxAround(begin, 0);
        box.add(at(to));
        std::vector<std::pair<double, std::int32_t>> found;
        tree_.visit(box.grown(widest_), [&](std::size_t other) {
            const auto node = static_cast<std::int32_t>(other);
            const Vec3 d = at(node) - begin;
            const double place = d.dot(along) / length;
            if (node == from || node == to || place <= 0 || place >= length) return;
            if ((d - place / length * along).norm() <= std::max(same, reach_[other]))
                found.emplace_back(place, node);
        });
        std::sort(found.begin(), found.end());
        std::vector<std::int32_t> nodes;
        for (const auto& [place, node] : found) nodes.push_back(node);
        return nodes;
    }

    /// Slivers whose corners are one node have no fan.
    void add(std::size_t p, const std::vector<std::int32_t>& corners) {
        const std::vector<std::int32_t> ring = ringOf(corners, outlines_[p].same);
        if (ring.size() < 3) return;
        const auto centre = static_cast<std::int32_t>(network_.nodes.size());
        network_.nodes.push_back(outlines_[p].centre);
        for (std::size_t k = 0; k < ring.size(); ++k) {
            network_.triangles.push_back({centre, ring[k], ring[(k + 1) % ring.size()]});
            network_.patch_of.push_back(static_cast<std::int32_t>(network_.patches.size()));
        }
        network_.patches.push_back(patches_[p]);
        network_.beside.push_back(facesBeside(state_, patches_[p]));
        network_.same.push_back(outlines_[p].same);
    }

    const Vec3& at(std::int32_t node) const { return network_.nodes[static_cast<std::size_t>(node)]; }

    const State& state_;
    Network& network_;
    std::vector<double> reach_;  ///< of each node: a corner that near is the same [m]
    double widest_ = 0;          ///< of these [m]
    std::vector<Outline> outlines_;
    std::vector<Patch> patches_;
    BoxTree tree_;
};

/// Each triangle becomes four, with new nodes at the middle of its edges.
void refine(Network& network) {
    std::map<Side, std::int32_t> middles;
    std::vector<Side>& halved = network.halved.emplace_back();
    const auto middle = [&](std::int32_t a, std::int32_t b) {
        const auto [entry, is_new] =
            middles.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(network.nodes.size()));
        if (is_new) {
            halved.push_back(entry->first);
            network.nodes.push_back(0.5 * (network.nodes[static_cast<std::size_t>(a)] +
                                           network.nodes[static_cast<std::size_t>(b)]));
        }
        return entry->second;
    };
    std::vector<std::array<std::int32_t, 3>> triangles;
    std::vector<std::int32_t> patch_of;
    for (std::size_t t = 0; t < network.triangles.size(); ++t) {
        const auto [a, b, c] = network.triangles[t];
        const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        triangles.insert(triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        patch_of.insert(patch_of.end(), 4, network.patch_of[t]);
    }
    network.triangles = std::move(triangles);
    network.patch_of = std::move(patch_of);
}

double medianSide(const Network& network) {
    std::vector<double> longest(network.patches.size(), 0.0);
    for (std::size_t t = 0; t < network.triangles.size(); ++t) {
        double& side = longest[static_cast<std::size_t>(network.patch_of[t])];
        side = std::max(side, (network.corner(t, 2) - network.corner(t, 1)).norm());
    }
    if (longest.empty()) return 0;
    const auto half = longest.begin() + static_cast<std::ptrdiff_t>(longest.size() / 2);
    std::nth_element(longest.begin(), half, longest.end());
    return *half;
}

/// Thickness across a section does not count, because gravity has no part along it; nor do level joints.
double meanHeight(const Network& network, const Vec3& down) {
    std::vector<Extent> extent(network.patches.size());
    for (std::size_t t = 0; t < network.triangles.size(); ++t)
        for (std::size_t k = 1; k < 3; ++k)
            extent[static_cast<std::size_t>(network.patch_of[t])].add(network.corner(t, k).dot(down));
    double sum = 0, squares = 0;
    for (const Extent& of : extent) sum += of.length(), squares += of.length() * of.length();
    return sum > kLevel * network.size ? squares / sum : network.size;
}

}  // namespace

Network networkOf(const State& state, int refinements, std::span<const FlowBoundary> boundaries) {
    Network network;
    Fans(state, network).make();
    const Gravity& gravity = state.geometry->model.gravity;
    network.size = medianSide(network);
    network.height = meanHeight(network, downward(gravity, gravity.tilt));
    const std::vector<Footprint> footprints = footprintsOf(network, boundaries, state.geometry->origin);
    const std::vector<char> divided = grade(network, footprints);
    makeDelaunay(network, divided, footprints);
    for (int k = 0; k < refinements; ++k) refine(network);
    return network;
}

}  // namespace talus::flow
