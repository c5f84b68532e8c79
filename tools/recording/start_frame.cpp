#include "recording/start_frame.h"

#include <atomic>

#include "cli/failures.h"
#include "talus/simulation.h"

namespace talus::tools {

StartFrame startFrame(Model model) {
    model.run.start = RunSettings::Start::unstressed;  // nothing is to be found before the first frame
    std::atomic<bool> stop{false};
    Control control;
    control.stop = &stop;
    StartFrame start;
    RunOutput output;
    output.begin = [&](const RunGeometry& geometry) { start.geometry = geometry; };
    output.light = [&](LightFrame&& frame) {
        if (frame.time == 0) start.frame = std::move(frame);
        stop = true;
    };
    valueOf(run(model, control, output));
    return start;
}

}  // namespace talus::tools
