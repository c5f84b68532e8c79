#include "step/motion_lanes.h"

namespace talus::stages {

constinit const MotionKernels kMotionAvx2 = kMotionKernels<Lanes>;

}  // namespace talus::stages
