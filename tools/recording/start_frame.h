#pragma once
// The blocks of a model as they lie before anything is computed.

#include "talus/frame.h"
#include "talus/model.h"

namespace talus::tools {

struct StartFrame {
    RunGeometry geometry;
    LightFrame frame;
};

/// Throws BadInput for a model that cannot be built.
StartFrame startFrame(Model model);

}  // namespace talus::tools
