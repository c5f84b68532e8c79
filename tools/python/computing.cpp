#include "python/computing.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "cli/common.h"
#include "cli/failures.h"

namespace talus::python {

/// The latest unreported progress, and whether the computation has ended.
struct Computing::Slot {
    std::mutex mutex;
    std::condition_variable changed;
    std::optional<Progress> latest;
    bool ended = false;
};

Control Computing::control() const {
    return {.progress = [this](const Progress& progress) { const_cast<Computing*>(this)->report(progress); },
            .stop = &stop_,
            .threads = threads_};
}

void Computing::report(const Progress& progress) {
    const std::lock_guard lock(slot_->mutex);
    slot_->latest = progress;
    slot_->changed.notify_one();
}

namespace {

constexpr auto kLook = std::chrono::milliseconds(50);  // for Ctrl-C

/// Signals, and the callback. Throws what they throw.
void attend(const Manner& manner, const std::optional<Progress>& news) {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (news && !manner.progress.is_none()) manner.progress(news->stage, news->fraction, news->detail);
}

}  // namespace

int threadsOf(const py::object& wish) {
    const auto number = py::reinterpret_steal<py::object>(PyNumber_Index(wish.ptr()));
    if (!number) throw py::error_already_set();
    int overflow = 0;
    const long threads = PyLong_AsLongAndOverflow(number.ptr(), &overflow);
    if (overflow != 0 || threads < 0 || threads > tools::kMostThreads)
        throw tools::BadInput(Error{"threads", "found " + py::str(number).cast<std::string>() +
                                                   ", allowed: 0 (all cores) to " +
                                                   std::to_string(tools::kMostThreads)});
    return static_cast<int>(threads);
}

void compute(const Manner& manner, const std::function<void(Computing&)>& body) {
    Computing computing(manner.threads);
    Computing::Slot slot;
    computing.slot_ = &slot;
    std::exception_ptr failed, stopped_by;
    std::thread worker([&] {
        try {
            body(computing);
        } catch (...) {
            failed = std::current_exception();
        }
        const std::lock_guard lock(slot.mutex);
        slot.ended = true;
        slot.changed.notify_one();
    });
    for (bool ended = false; !ended;) {
        std::optional<Progress> news;
        {
            const py::gil_scoped_release others_may;
            std::unique_lock lock(slot.mutex);
            slot.changed.wait_for(lock, kLook, [&] { return slot.ended || slot.latest; });
            ended = slot.ended;
            news = std::exchange(slot.latest, std::nullopt);
        }
        if (stopped_by) continue;
        try {
            attend(manner, news);
        } catch (...) {
            stopped_by = std::current_exception();
            computing.requestStop();
        }
    }
    {
        const py::gil_scoped_release others_may;
        worker.join();
    }
    if (stopped_by) std::rethrow_exception(stopped_by);
    if (failed) std::rethrow_exception(failed);
}

}  // namespace talus::python
