// `ends_at` of a [[joint_set]]: its joints lie between the planes of another joint.

#include "scenario/rock_mass.h"

namespace talus::formats::scenario {

void resolveEndingSets(Report& report, RockMassInput& input) {
    for (EndingSetInput& each : input.ending_sets) {
        const std::string field = each.ending.set.field + ".ends_at";
        if (input.joint_names.empty()) {
            report.add(
                each.place, field,
                "found " + quoted(each.other) +
                    ", but no other joint has a name, allowed: the name of a joint set or single joint");
            continue;
        }
        if (const auto index = input.joint_names.resolve(report, each.place, field, each.other))
            each.ending.ends_at = input.joint_of_name[static_cast<std::size_t>(*index)];
    }
}

void appendEndingSets(Report& report, RockMassInput& input) {
    std::vector<SingleJoint> all;
    for (std::size_t k = 0; k < input.ending_sets.size(); ++k) {
        auto joints = endingJoints(input.ending_sets[k].ending, k, input.description);
        if (!joints) {
            for (const Error& error : joints.errors()) {
                report.add(report.placeOf(error.field).value_or(input.ending_sets[k].place), error.field,
                           error.message);
            }
            continue;
        }
        for (SingleJoint& joint : *joints) all.push_back(std::move(joint));
    }
    for (SingleJoint& joint : all) input.description.singles.push_back(std::move(joint));
}

}  // namespace talus::formats::scenario
