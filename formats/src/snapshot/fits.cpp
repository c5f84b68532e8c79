// Whether the arrays of a message fit each other: readers index them without looking again.

#include <algorithm>

#include "snapshot/convert.h"

namespace talus::formats {
namespace {

template <class Number>
bool sized(const VectorList<Number>& list, std::size_t n) {
    return list.x.size() == n && list.y.size() == n && list.z.size() == n;
}

bool sized(const QuaternionList& list, std::size_t n) {
    return list.w.size() == n && list.x.size() == n && list.y.size() == n && list.z.size() == n;
}

template <class... Arrays>
bool allSized(std::size_t n, const Arrays&... arrays) {
    return ((arrays.size() == n) && ...);
}

template <class Index>
bool within(const std::vector<Index>& values, std::int64_t low, std::size_t high) {
    return std::all_of(values.begin(), values.end(), [&](Index value) {
        return value >= low && static_cast<std::int64_t>(value) < static_cast<std::int64_t>(high);
    });
}

template <class Index>
bool areBegins(const std::vector<Index>& begins, std::size_t items, std::size_t total) {
    return begins.size() == items + 1 && begins.front() == 0 &&
           std::is_sorted(begins.begin(), begins.end()) && begins.back() == static_cast<Index>(total);
}

bool fitsWet(const FullFrame& frame, std::size_t blocks, std::size_t waters) {
    const FrameWetPatches& w = frame.wet;
    const std::size_t n = w.block.size();
    return allSized(n, w.water, w.interface) && within(w.block, 0, blocks) && within(w.water, 0, waters) &&
           within(w.interface, -1, frame.interfaces.size()) && sized(w.origin, n) && sized(w.e1, n) &&
           sized(w.e2, n) && sized(w.force, n) && sized(w.moment, n) &&
           areBegins(w.vertex_begin, n, w.vertex_x.size()) && w.vertex_x.size() == w.vertex_y.size();
}

}  // namespace

bool fits(const SnapshotHeader& header) {
    const RunGeometry& g = header.geometry;
    const std::size_t n = header.names.size();
    const std::size_t faces = g.face_joint.size();
    if (!allSized(n, header.motions, g.mass, g.size) || !sized(g.centroid, n) || !sized(g.orientation, n) ||
        !sized(g.vertex, g.vertex.x.size()) || !areBegins(g.vertex_begin, n, g.vertex.x.size()) ||
        !areBegins(g.face_begin, n, faces) || !areBegins(g.face_vertex_begin, faces, g.face_vertex.size()) ||
        !within(g.face_vertex, 0, g.vertex.x.size()) || !within(g.face_joint, 0, header.joints.size()))
        return false;
    if (header.failure && header.failure->roles.size() != n) return false;
    for (const Motion motion : header.motions)
        if (motion > Motion::driven) return false;
    for (const Water& water : header.waters) {
        for (const WetFace& wall : water.walls)
            if (wall.block < 0 || static_cast<std::size_t>(wall.block) >= n || wall.face < 0 ||
                wall.face >= g.face_begin[static_cast<std::size_t>(wall.block) + 1] -
                                 g.face_begin[static_cast<std::size_t>(wall.block)])
                return false;
        if (water.pair && !within(std::vector{water.pair->first, water.pair->second}, 0, n)) return false;
    }
    return true;
}

bool fits(const LightFrame& frame, const SnapshotHeader& header) {
    const std::size_t n = header.names.size();
    return sized(frame.displacement, n) && sized(frame.rotation, n) && sized(frame.velocity, n) &&
           allSized(header.waters.size(), frame.water.level, frame.water.table, frame.water.drained);
}

bool fits(const FullFrame& frame, const SnapshotHeader& header) {
    const std::size_t n = header.names.size();
    const FrameBlocks& b = frame.blocks;
    const FrameInterfaces& f = frame.interfaces;
    const FramePoints& p = frame.points;
    const std::size_t m = f.size(), k = p.size();
    return sized(b.position, n) && sized(b.orientation, n) && sized(b.velocity, n) &&
           sized(b.angular_momentum, n) && sized(b.force, n) && sized(b.torque, n) &&
           sized(b.inverse_inertia, n) && allSized(n, b.inverse_mass) &&
           allSized(m, f.block_b, f.face_a, f.face_b, f.joint, f.area) && within(f.block_a, 0, n) &&
           within(f.block_b, 0, n) && within(f.joint, 0, header.joints.size()) && sized(f.origin_a, m) &&
           sized(f.e1_a, m) && sized(f.e2_a, m) && sized(f.origin_b, m) && sized(f.e1_b, m) &&
           sized(f.e2_b, m) && sized(f.reference_gap, m) && sized(f.force, m) && sized(f.moment_a, m) &&
           sized(f.moment_b, m) && areBegins(f.point_begin, m, k) &&
           areBegins(f.patch_begin, m, f.patch_xi.size()) && f.patch_xi.size() == f.patch_eta.size() &&
           allSized(k, p.xi, p.eta, p.offset_1, p.offset_2, p.bond, p.normal, p.shear_1, p.shear_2, p.water,
                    p.state, p.mobilised) &&
           (p.dilation.empty() || p.dilation.size() == k) && fitsWet(frame, n, header.waters.size());
}

}  // namespace talus::formats
