#include "equilibrium/elimination_lanes.h"

namespace talus::equilibrium {

constinit const EliminationKernel kEliminateAvx2 = eliminate;

}  // namespace talus::equilibrium
