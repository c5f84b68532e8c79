#pragma once
// Long computations on behalf of Python: without its lock, with its progress callback, and stopped by Ctrl-C.

#include <pybind11/functional.h>
#include <pybind11/pybind11.h>

#include <atomic>
#include <exception>
#include <functional>

#include "talus/analysis.h"

namespace talus::python {

namespace py = pybind11;

/// The number of threads that a caller asks for. Throws BadInput for one that is negative or too large, and
/// TypeError.
int threadsOf(const py::object& wish);

/// A caller's options: threads (0: all cores), and a callback (stage, fraction, detail) or None.
struct Manner {
    int threads = 0;
    py::object progress = py::none();
};

/// Progress reports and interruption for the computation.
class Computing {
 public:
    Control control() const;
    const std::atomic<bool>& stop() const { return stop_; }
    void requestStop() { stop_ = true; }
    void report(const Progress& progress);

 private:
    friend void compute(const Manner& manner, const std::function<void(Computing&)>& body);
    explicit Computing(int threads) : threads_(threads) {}

    struct Slot;
    int threads_;
    std::atomic<bool> stop_{false};
    Slot* slot_ = nullptr;
};

/// Runs `body` in a thread of its own, while the calling thread handles signals and calls the callback, so
/// that any computation can be stopped. Throws what the body or the callback threw, and KeyboardInterrupt,
/// once the body has come to its end.
void compute(const Manner& manner, const std::function<void(Computing&)>& body);

}  // namespace talus::python
