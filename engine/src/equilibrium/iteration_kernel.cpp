#include "equilibrium/iteration_lanes.h"

namespace talus::equilibrium {

constinit const IterationKernels kIterateScalar = kIterate;

}  // namespace talus::equilibrium
