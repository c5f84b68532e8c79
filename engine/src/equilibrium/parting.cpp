#include "equilibrium/parting.h"

#include <algorithm>

#include "forces/contact_forces.h"

namespace talus::equilibrium {

Parting::Parting(const State& state, const Balance& balance, Poses poses) : poses_(std::move(poses)) {
    const Interfaces& f = state.interfaces;
    std::vector<char> touches(state.blocks.size(), 0);
    for (const ActiveInterface& i : balance.interfaces) {
        touches[i.block_a] = touches[i.block_b] = 1;
        const RelativePose pose = relativePose(poses_.position, poses_.orientation, f, i.interface);
        const auto own = [&](std::size_t block, const Vec3& x) {
            return Vec3(poses_.turn[block].transpose() * (x - poses_.position.get(block)));
        };
        for (std::size_t k = 0; k < f.cornerCount(i.interface); ++k) {
            const std::size_t slot = f.cornerSlot(i.interface, k);
            const Vec3 x = pose.origin + f.corners.get(slot, 0) * pose.e1 + f.corners.get(slot, 1) * pose.e2;
            corners_.push_back({i.block_a, i.block_b, own(i.block_a, x), own(i.block_b, x),
                                poses_.turn[i.block_a].transpose() * pose.e1.cross(pose.e2)});
        }
    }
    for (const std::size_t block : balance.block)
        if (!touches[block]) alone_.push_back(block);
}

Vec3 Parting::apart(const Corner& corner, const Poses& poses) {
    const auto place = [&](std::size_t block, const Vec3& in) {
        return Vec3(poses.position.get(block) + poses.turn[block] * in);
    };
    return place(corner.block_b, corner.in_b) - place(corner.block_a, corner.in_a);
}

double Parting::now(const Poses& poses) const {
    double most = 0;
    for (const Corner& corner : corners_) most = std::max(most, apart(corner, poses).squaredNorm());
    for (const std::size_t block : alone_)
        most = std::max(most, (poses.position.get(block) - poses_.position.get(block)).squaredNorm());
    return std::sqrt(most);
}

double Parting::slidNow(const Poses& poses) const {
    double most = 0;
    for (const Corner& corner : corners_) {
        const Vec3 normal = poses.turn[corner.block_a] * corner.normal_in_a, way = apart(corner, poses);
        most = std::max(most, (way - way.dot(normal) * normal).squaredNorm());
    }
    return std::sqrt(most);
}

}  // namespace talus::equilibrium
