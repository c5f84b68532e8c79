#pragma once
// Groups of interfaces in registers of several doubles; included by one source file per instruction set and
// kernel.

#include "forces/contact_group.h"
#include "simd/lanes.h"

namespace talus {
namespace {

using simd::Lanes;

/// As many interfaces of a group as a register holds. Where the group has fewer, the blocks and joints of the
/// last one are repeated; the slots beyond belong to the group, and their results are not used.
template <>
struct Members<Lanes> {
    static constexpr int kWidth = simd::kWidth;
    int first_lane;
    std::int32_t member[kWidth];

    TALUS_KERNEL Members(const InterfaceGroup& group, int lane) : first_lane(lane) {
        const int last = group.size - 1;
        for (int l = 0; l < kWidth; ++l) member[l] = group.begin + (lane + l < last ? lane + l : last);
    }

    TALUS_KERNEL Lanes load(const double* row) const { return simd::loadLanes(row + first_lane); }
    TALUS_KERNEL void store(double* row, Lanes v) const { simd::storeLanes(row + first_lane, v); }
    /// Records of nine: in three overlapping pieces of four.
    TALUS_KERNEL void storeWrench(double* to, const Triple<Lanes>& force, const Triple<Lanes>& moment_a,
                                  const Triple<Lanes>& moment_b) const {
        constexpr std::ptrdiff_t kStride = kWrenchQuantities;
        to += kStride * first_lane;
        simd::storeRecords(to, kStride, {{force.x, force.y, force.z, moment_a.x}});
        simd::storeRecords(to + 4, kStride, {{moment_a.y, moment_a.z, moment_b.x, moment_b.y}});
        simd::storeRecords(to + 5, kStride, {{moment_a.z, moment_b.x, moment_b.y, moment_b.z}});
    }
    TALUS_KERNEL void storeFour(double* to, std::ptrdiff_t stride, const Lanes* four) const {
        simd::storeRecords(to + stride * first_lane, stride, {{four[0], four[1], four[2], four[3]}});
    }
    TALUS_KERNEL Lanes take(const double* values) const {
        Lanes result;
        for (int l = 0; l < kWidth; ++l) result.v[l] = values[member[l]];
        return result;
    }
    TALUS_KERNEL Lanes gather(const double* values, const std::int32_t* index) const {
        Lanes result;
        for (int l = 0; l < kWidth; ++l) result.v[l] = values[index[member[l]]];
        return result;
    }
    TALUS_KERNEL Lanes gather(const contact::JointLaw* laws, double contact::JointParameters<double>::*field,
                              const std::int32_t* index) const {
        Lanes result;
        for (int l = 0; l < kWidth; ++l) result.v[l] = laws[index[member[l]]].*field;
        return result;
    }
    TALUS_KERNEL simd::LaneMask gatherFlag(const contact::JointLaw* laws,
                                           bool contact::JointParameters<double>::*flag,
                                           const std::int32_t* index) const {
        simd::LaneMask mask{};
        for (int l = 0; l < kWidth; ++l) simd::setLane(mask, l, laws[index[member[l]]].*flag);
        return mask;
    }
    /// Lanes without a curve get another's, and its result is not used.
    TALUS_KERNEL simd::TablesOf<Lanes> gatherCurve(const contact::JointLaw* laws,
                                                   const std::int32_t* index) const {
        simd::TablesOf<Lanes> curves;
        const double* some = nullptr;
        for (int l = 0; l < kWidth; ++l)
            if (const double* curve = laws[index[member[l]]].curve.at) some = curve;
        for (int l = 0; l < kWidth; ++l) {
            const double* curve = laws[index[member[l]]].curve.at;
            curves.set(l, curve != nullptr ? curve : some);
        }
        return curves;
    }
    TALUS_KERNEL PoseOf<Lanes> gatherPose(const double* position, const double* orientation,
                                          const std::int32_t* block) const {
        std::int32_t item[kWidth];
        for (int l = 0; l < kWidth; ++l) item[l] = block[member[l]];
        const simd::FourLanes x = simd::loadRecords(position, item), q = simd::loadRecords(orientation, item);
        return {{x.number[0], x.number[1], x.number[2]},
                simd::rotationOf(q.number[0], q.number[1], q.number[2], q.number[3])};
    }
};

}  // namespace
}  // namespace talus
