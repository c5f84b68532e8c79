#include "stages/motion_kernel.h"

namespace talus::stages {

const MotionKernels kMotionScalar = kMotionKernels<double>;

}  // namespace talus::stages
