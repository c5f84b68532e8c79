#include "stages/motion_kernel.h"

namespace talus::stages {

void driftScalar(const MotionView& view, std::size_t begin, std::size_t end) {
    driftRange<double>(view, begin, end);
}

void sumWrenchesScalar(const GatherView& view, std::size_t begin, std::size_t end) {
    sumWrenches(view, begin, end);
}

void kickScalar(const GatherView& view, std::size_t begin, std::size_t end) {
    kickRange<double>(view, begin, end);
}

}  // namespace talus::stages
