#include "step/motion_kernel.h"

namespace talus {

constinit const MotionKernels kMotionScalar = kMotionKernels<double>;

}  // namespace talus
