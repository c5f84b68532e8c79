#pragma once
// Drift and kick on registers of several doubles; included by one source file per instruction set.

#include "simd/lanes.h"
#include "step/motion_kernel.h"

namespace talus {
namespace {

using simd::Lanes;

template <>
struct Consecutive<Lanes> {
    static constexpr std::size_t kWidth = simd::kWidth;
    std::size_t block;

    TALUS_KERNEL Lanes load(const double* values) const { return simd::loadLanes(values + block); }
    TALUS_KERNEL void store(double* values, Lanes v) const { simd::storeLanes(values + block, v); }
    TALUS_KERNEL simd::LaneMask flags(const std::uint8_t* values) const {
        simd::LaneMask mask{};
        for (int l = 0; l < simd::kWidth; ++l)
            simd::setLane(mask, l, values[block + static_cast<std::size_t>(l)] != 0);
        return mask;
    }
    TALUS_KERNEL Four<Lanes> loadFour(const double* records) const {
        const simd::FourLanes r = simd::loadRecords(records + 4 * block);
        return {r.number[0], r.number[1], r.number[2], r.number[3]};
    }
    TALUS_KERNEL void storeFour(double* records, const Four<Lanes>& v) const {
        simd::storeRecords(records + 4 * block, 4, {{v.a, v.b, v.c, v.d}});
    }
};

template <>
struct Last<Lanes> : Consecutive<Lanes> {
    std::size_t from;

    TALUS_KERNEL simd::LaneMask isNew() const {
        simd::LaneMask mask{};
        for (std::size_t l = 0; l < kWidth; ++l) simd::setLane(mask, static_cast<int>(l), block + l >= from);
        return mask;
    }
    TALUS_KERNEL void store(double* values, Lanes v) const {
        Consecutive<Lanes>::store(values, select(isNew(), v, load(values)));
    }
    TALUS_KERNEL void storeFour(double* records, const Four<Lanes>& v) const {
        const simd::LaneMask mask = isNew();
        const Four<Lanes> old = loadFour(records);
        Consecutive<Lanes>::storeFour(records, {select(mask, v.a, old.a), select(mask, v.b, old.b),
                                                select(mask, v.c, old.c), select(mask, v.d, old.d)});
    }
};

}  // namespace
}  // namespace talus
