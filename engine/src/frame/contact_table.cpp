#include "talus/contact_table.h"

#include <Eigen/Geometry>

#include "talus/polyhedron.h"

namespace talus {
namespace {

Vec3 at(const VectorList<double>& list, std::size_t k) { return {list.x[k], list.y[k], list.z[k]}; }

void add(VectorList<double>& list, const Vec3& v) {
    list.x.push_back(v.x()), list.y.push_back(v.y()), list.z.push_back(v.z());
}

/// One side of an interface where it is now, in the model frame.
struct Side {
    Vec3 origin, e1, e2;
};

Side sideOf(const FullFrame& frame, std::int32_t block, const VectorList<double>& origin,
            const VectorList<double>& e1, const VectorList<double>& e2, std::size_t i) {
    const auto b = static_cast<std::size_t>(block);
    const QuaternionList& q = frame.blocks.orientation;
    const Mat3 turn = Eigen::Quaterniond(q.w[b], q.x[b], q.y[b], q.z[b]).toRotationMatrix();
    return {Vec3(frame.origin_x, frame.origin_y, frame.origin_z) + at(frame.blocks.position, b) +
                turn * at(origin, i),
            turn * at(e1, i), turn * at(e2, i)};
}

/// Gap at the origin and its slopes along e1 and e2, as the law takes them (forces/contact_kernel.h).
Vec3 gapOf(const Side& a, const Side& b, const Vec3& normal, const Vec3& reference) {
    return Vec3((b.origin - a.origin).dot(normal), b.e1.dot(normal), b.e2.dot(normal)) - reference;
}

void addPoint(const FramePoints& p, std::size_t k, const Side& a, const Vec3& normal, const Vec3& gap,
              ContactTable& table) {
    const Vec3 shear = p.shear_1[k] * a.e1 + p.shear_2[k] * a.e2;
    add(table.position, a.origin + p.xi[k] * a.e1 + p.eta[k] * a.e2);
    add(table.normal, normal);
    add(table.shear, shear);
    add(table.force, shear + p.normal[k] * normal);
    table.gap.push_back(gap.dot(Vec3(1, p.xi[k], p.eta[k])));
    table.area.push_back(p.area[k]);
    table.normal_force.push_back(p.normal[k]);
    table.water_force.push_back(p.water[k]);
    table.mobilised.push_back(p.mobilised[k]);
    table.state.push_back(p.state[k]);
}

}  // namespace

ContactTable contactTable(const FullFrame& frame) {
    const FrameInterfaces& f = frame.interfaces;
    ContactTable table;
    for (std::size_t i = 0; i < f.size(); ++i) {
        if (f.isIdle(i)) continue;
        const Side a = sideOf(frame, f.block_a[i], f.origin_a, f.e1_a, f.e2_a, i);
        const Side b = sideOf(frame, f.block_b[i], f.origin_b, f.e1_b, f.e2_b, i);
        const Vec3 normal = a.e1.cross(a.e2), gap = gapOf(a, b, normal, at(f.reference_gap, i));
        for (auto k = static_cast<std::size_t>(f.point_begin[i]);
             k < static_cast<std::size_t>(f.point_begin[i + 1]); ++k) {
            table.interface.push_back(static_cast<std::int32_t>(i));
            table.block_a.push_back(f.block_a[i]);
            table.block_b.push_back(f.block_b[i]);
            table.joint.push_back(f.joint[i]);
            addPoint(frame.points, k, a, normal, gap, table);
        }
    }
    return table;
}

}  // namespace talus
