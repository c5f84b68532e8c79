#include "equilibrium/response_kernel.h"
#include "forces/contact_members.h"

namespace talus::equilibrium {

constinit const ResponseKernel kRespondAvx2 = respond<Lanes>;

}  // namespace talus::equilibrium
