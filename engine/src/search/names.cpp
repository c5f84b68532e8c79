// What results are called in files and on screens.

#include "talus/analysis.h"

namespace talus {

const char* toString(SearchStatus status) {
    switch (status) {
        case SearchStatus::found:
            return "found";
        case SearchStatus::unstable_at_start:
            return "unstable_at_start";
        case SearchStatus::stable_to_stop:
            return "stable_to_stop";
        case SearchStatus::interrupted:
            return "undecided";
        case SearchStatus::undecided:
            break;
    }
    return "undecided";
}

const char* toString(FailureMode mode) {
    switch (mode) {
        case FailureMode::sliding:
            return "sliding";
        case FailureMode::toppling:
            return "toppling";
        case FailureMode::mixed:
            return "mixed";
        case FailureMode::none:
            break;
    }
    return "none";
}

const char* toString(Verdict verdict) {
    switch (verdict) {
        case Verdict::stable:
            return "stable";
        case Verdict::failing:
            return "failing";
        case Verdict::undecided:
            break;
    }
    return "undecided";
}

}  // namespace talus
