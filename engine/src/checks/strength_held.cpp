#include "checks/strength_held.h"

#include <algorithm>
#include <set>
#include <utility>

#include "build/wet_joints.h"
#include "checks/closed_volumes.h"
#include "measure/words.h"
#include "talus/held.h"

namespace talus::checks {

std::vector<std::string> strengthsHeld(const Model& model) {
    std::vector<std::string> lines;
    std::set<std::string> told;
    for (const Joint& joint : model.joints) {
        const std::string name = joint.name.substr(0, joint.name.find('@'));
        if (!changesStrength(joint) || !told.insert(name).second) continue;
        lines.push_back("joint." + name + ".strength_over_time: this answer is for time 0, with " +
                        formatted("%.4g", strengthFactor(joint, 0)) +
                        " times the strength; talus storm gives the factor of safety over time");
    }
    return lines;
}

std::optional<std::string> wetJointsHeld(const Model& model) {
    if (!hasWetJoints(model)) return std::nullopt;
    const auto changes = [](const Water& each) {
        const auto differs = [&](const LevelPoint& point) { return point.value != each.level.front().value; };
        return each.closed || std::any_of(each.level.begin(), each.level.end(), differs);
    };
    const auto water = std::find_if(model.waters.begin(), model.waters.end(), changes);
    if (water == model.waters.end()) return std::nullopt;
    return wetStrengthKey(model) + ": joints stay as wet as at time 0, while the level of " + water->field +
           " changes; talus storm takes what is wet at each level";
}

}  // namespace talus::checks

std::vector<std::string> talus::heldAtTimeZero(const Model& model) {
    std::vector<std::string> lines = checks::levelsHeld(model);
    for (std::string& line : checks::strengthsHeld(model)) lines.push_back(std::move(line));
    return lines;
}
