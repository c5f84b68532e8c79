#pragma once
// What long work asks of its caller now and then: whether to go on.

#include "talus/control.h"

namespace talus {

inline bool isStopped(const std::atomic<bool>* stop) {
    return stop != nullptr && stop->load(std::memory_order_relaxed);
}
inline bool isStopped(const Control& control) { return isStopped(control.stop); }

}  // namespace talus
