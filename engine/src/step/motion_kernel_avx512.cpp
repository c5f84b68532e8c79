#include "step/motion_lanes.h"

namespace talus::stages {

constinit const MotionKernels kMotionAvx512 = kMotionKernels<Lanes>;

}  // namespace talus::stages
