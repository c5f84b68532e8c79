#include "rates_kernel.h"

namespace talus::bench {

Rates plainRates() { return theseRates(); }

}  // namespace talus::bench
