#include "equilibrium/iteration_lanes.h"

namespace talus::equilibrium {

constinit const IterationKernels kIterateAvx512 = kIterate;

}  // namespace talus::equilibrium
