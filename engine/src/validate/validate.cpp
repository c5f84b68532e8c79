#include "validate/validate.h"

#include "validate/findings.h"

namespace talus {

std::vector<std::string> validate(const State& state) {
    Findings findings;
    for (const auto part :
         {checkBlocks, checkLayout, checkFrames, checkPlaces, checkPoints, checkIncidence, checkWalls}) {
        part(state, findings);
        if (!findings.none()) break;  // later parts index arrays that this part has checked
    }
    return findings.take();
}

}  // namespace talus
