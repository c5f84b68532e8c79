#include "rates_kernel.h"

namespace talus::bench {

Rates avx2Rates() { return theseRates(); }

}  // namespace talus::bench
