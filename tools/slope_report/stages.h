#pragma once
// One computation as a part of a longer one: its progress is a range of the whole.

#include <string>

#include "talus/analysis.h"

namespace talus::tools {

/// \param from, to  which range of the whole, 0..1
inline Control stageOf(const Control& whole, const std::string& name, double from, double to) {
    Control part = whole;
    if (whole.progress) {
        part.progress = [report = whole.progress, name, from, to](const Progress& progress) {
            report({name, from + progress.fraction * (to - from), progress.stage + "  " + progress.detail});
        };
    }
    return part;
}

}  // namespace talus::tools
