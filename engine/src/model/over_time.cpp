#include "model/over_time.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace talus {

double valueAt(const std::vector<LevelPoint>& table, double time) {
    if (time <= table.front().time) return table.front().value;
    for (std::size_t k = 1; k < table.size(); ++k)
        if (time <= table[k].time) {
            const double share = (time - table[k - 1].time) / (table[k].time - table[k - 1].time);
            return table[k - 1].value + share * (table[k].value - table[k - 1].value);
        }
    return table.back().value;
}

double integralOver(const std::vector<LevelPoint>& table, double from, double to) {
    double sum = 0, time = from, value = valueAt(table, from);
    const auto addUpTo = [&](double next) {
        const double there = valueAt(table, next);
        sum += 0.5 * (value + there) * (next - time);
        time = next;
        value = there;
    };
    for (const LevelPoint& point : table)
        if (point.time > from && point.time < to) addUpTo(point.time);
    addUpTo(to);
    return sum;
}

double levelAt(const Water& water, double time) {
    return water.level.empty() ? 0.0 : valueAt(water.level, time);
}

double factorAt(const AppliedLoad& load, double time) {
    return load.factor.empty() ? 1.0 : valueAt(load.factor, time);
}

double strengthFactor(const Joint& joint, double time) {
    return joint.strength_over_time.empty() ? 1.0 : valueAt(joint.strength_over_time, time);
}

bool changesStrength(const Joint& joint) {
    const std::vector<LevelPoint>& table = joint.strength_over_time;
    return std::any_of(table.begin(), table.end(),
                       [&](const LevelPoint& point) { return point.value != table.front().value; });
}

Joint strengthened(Joint joint, double factor) {
    if (factor == 1) return joint;  // to the bit: an angle's tangent and back rounds
    for (const JointProperty& property : kJointProperties) {
        if (!isStrength(joint, property)) continue;
        const double value = lawValue(joint, property, 1, factor);
        joint.*property.value = property.isAngle() ? std::atan(value) : value;
    }
    return joint;
}

Joint strengthAt(Joint joint, double time) {
    const double factor = strengthFactor(joint, time);
    joint.strength_over_time.clear();
    return strengthened(std::move(joint), factor);
}

double frictionAngleAt(const Joint& joint, double time) {
    return strengthFactor(joint, time) == 1 ? frictionAngle(joint) : frictionAngle(strengthAt(joint, time));
}

std::vector<Joint> strengthsAt(std::vector<Joint> joints, double time) {
    for (Joint& joint : joints) joint = strengthAt(std::move(joint), time);
    return joints;
}

}  // namespace talus
