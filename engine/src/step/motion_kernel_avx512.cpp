#include "step/motion_lanes.h"

namespace talus {

constinit const MotionKernels kMotionAvx512 = kMotionKernels<Lanes>;

}  // namespace talus
