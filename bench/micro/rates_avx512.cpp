#include "rates_kernel.h"

namespace talus::bench {

Rates avx512Rates() { return theseRates(); }

}  // namespace talus::bench
