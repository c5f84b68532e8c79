#include "simd/lanes.h"
#include "stages/motion_kernel.h"

namespace talus::stages {
namespace {

using simd::Lanes;

template <>
struct Consecutive<Lanes> {
    static constexpr std::size_t kWidth = simd::kLanes;
    std::size_t block;
    TALUS_KERNEL Lanes load(const double* values) const { return simd::loadLanes(values + block); }
    TALUS_KERNEL void store(double* values, Lanes v) const { simd::storeLanes(values + block, v); }
    TALUS_KERNEL simd::LaneMask flags(const std::uint8_t* values) const {
        simd::LaneMask mask;
        for (std::size_t l = 0; l < kWidth; ++l) mask.bits[l] = values[block + l] != 0 ? -1 : 0;
        return mask;
    }
};

}  // namespace

void driftAvx2(const MotionView& view, std::size_t begin, std::size_t end) {
    driftRange<double>(view, driftRange<Lanes>(view, begin, end), end);
}

}  // namespace talus::stages
