#include "stages/motion_lanes.h"

namespace talus::stages {

void driftAvx2(const MotionView& view, std::size_t begin, std::size_t end) {
    driftRange<double>(view, driftRange<Lanes>(view, begin, end), end);
}

void sumWrenchesAvx2(const GatherView& view, std::size_t begin, std::size_t end) {
    sumWrenches(view, begin, end);
}

void kickAvx2(const GatherView& view, std::size_t begin, std::size_t end) {
    kickRange<double>(view, kickRange<Lanes>(view, begin, end), end);
}

}  // namespace talus::stages
