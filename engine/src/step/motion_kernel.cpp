#include "step/motion_kernel.h"

namespace talus::stages {

constinit const MotionKernels kMotionScalar = kMotionKernels<double>;

}  // namespace talus::stages
