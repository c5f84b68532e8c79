#include "step/motion_lanes.h"

namespace talus {

constinit const MotionKernels kMotionAvx2 = kMotionKernels<Lanes>;

}  // namespace talus
