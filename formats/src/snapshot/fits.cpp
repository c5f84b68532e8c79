// Whether the arrays of a message fit each other: readers index them without looking again.

#include <algorithm>

#include "snapshot/convert.h"
#include "talus/frame_table.h"

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

/// An older file, and one without supports, has nothing of them.
bool supportsFit(const SupportLines& lines, std::size_t blocks) {
    if (lines.name.empty()) return lines.block.empty();
    const std::size_t points = lines.block.size();
    return sized(lines.point, points) && areBegins(lines.point_begin, lines.name.size(), points) &&
           within(lines.block, 0, blocks);
}

bool flowFits(const SnapshotFlow& flow, std::size_t blocks, std::size_t joints) {
    const std::size_t nodes = flow.pressure.size(), triangles = flow.joint.size();
    return sized(flow.node, nodes) && allSized(3 * triangles, flow.triangle) &&
           allSized(triangles, flow.block_a, flow.block_b) && within(flow.triangle, 0, nodes) &&
           within(flow.joint, 0, joints) && within(flow.block_a, 0, blocks) &&
           within(flow.block_b, 0, blocks);
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
    if ((!g.face_part.empty() || !g.face_inner.empty()) && !allSized(faces, g.face_part, g.face_inner))
        return false;
    if (!supportsFit(g.supports, n)) return false;
    if (header.flow && !flowFits(*header.flow, n, header.joints.size())) return false;
    if (header.failure && header.failure->roles.size() != n) return false;
    if (header.failure && !header.failure->factors.empty() && header.failure->factors.size() != n)
        return false;
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
           allSized(header.waters.size(), frame.water.level, frame.water.table, frame.water.drained) &&
           allSized(header.geometry.supports.name.size(), frame.supports.force, frame.supports.utilisation,
                    frame.supports.broken);
}

bool fits(const FullFrame& frame, const SnapshotHeader& header) {
    return !misfit(frame, {header.names.size(), header.waters.size(), header.joints.size()});
}

}  // namespace talus::formats
