#include "equilibrium/iteration_lanes.h"

namespace talus::equilibrium {

constinit const IterationKernels kIterateAvx2 = kIterate;

}  // namespace talus::equilibrium
