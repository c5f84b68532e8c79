#pragma once
// Clocks and memory of this process.

#include <string>

namespace talus::bench {

double wallSeconds();     ///< since some fixed instant
double processSeconds();  ///< processor time of all threads
double residentBytes();
double peakBytes();       ///< largest resident memory since resetPeakMemory, or since the start
void resetPeakMemory();   ///< Linux; elsewhere the peak is since the start
double availableBytes();  ///< memory that can still be taken without swapping
std::string processorName();

/// Cache sizes as the system tells them [bytes]; typical ones where it does not.
struct Caches {
    double level2 = 1 << 20, level3 = 32 << 20;
};
Caches caches();

}  // namespace talus::bench
