#include "equilibrium/elimination_lanes.h"

namespace talus::equilibrium {

constinit const EliminationKernel kEliminateAvx512 = eliminate;

}  // namespace talus::equilibrium
