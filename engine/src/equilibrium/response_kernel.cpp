#include "equilibrium/response_kernel.h"

namespace talus::equilibrium {

constinit const ResponseKernel kRespondScalar = respond<double>;

}  // namespace talus::equilibrium
