#include "stages/motion_kernel.h"

namespace talus::stages {

void driftScalar(const MotionView& view, std::size_t begin, std::size_t end) {
    driftRange<double>(view, begin, end);
}

}  // namespace talus::stages
