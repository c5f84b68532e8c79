#include "equilibrium/elimination_lanes.h"

namespace talus::equilibrium {

constinit const EliminationKernel kEliminateScalar = eliminate;

}  // namespace talus::equilibrium
