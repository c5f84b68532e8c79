#include "checks/joint_order.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "measure/words.h"
#include "model/joint_pairs.h"
#include "model/over_time.h"
#include "talus/angles.h"
#include "talus/wet_joint_name.h"

namespace talus::checks {
namespace {

// Entries of a table are equal but for the rounding of its interpolation: then the first is named.
constexpr double kSame = 1e-9;

/// Joints of two faces, with their strengths where water wets them.
struct Meeting {
    Joint kept, other;
};

/// By their names: with those that were derived for wet interfaces.
using Names = std::pair<std::string, std::string>;

/// A joint derived from one of the file's ("default@18.5deg") is named as that one.
std::string nameInFile(const Joint& joint) { return joint.name.substr(0, joint.name.find('@')); }

/// Pairs that the model itself gives a joint, sorted: between these neither face's is chosen.
std::vector<PairJoint> givenPairs(const Model& model) {
    std::vector<PairJoint> pairs = model.pair_joints;
    std::erase_if(pairs, [&](const PairJoint& pair) {
        return readWetJointName(model.joints[static_cast<std::size_t>(pair.joint)].name).has_value();
    });
    return sortedByBlocks(std::move(pairs));
}

/// The other face's joint is as wet as the kept one.
Meeting meetingOf(const Joint& kept, const Joint& one, const Joint& two) {
    const auto wet = readWetJointName(kept.name);
    const Joint& other = one.name == (wet ? wet->joint : kept.name) ? two : one;
    return {kept, wet ? strengthened(other, 1 - wet->share * (1 - other.wet_strength_factor)) : other};
}

std::map<Names, Meeting> meetingsOf(const State& state) {
    const Model& model = state.geometry->model;
    const Interfaces& f = state.interfaces;
    const std::vector<PairJoint> given = givenPairs(model);
    std::map<Names, Meeting> meetings;
    const auto joint = [&](std::int32_t j) -> const Joint& {
        return model.joints[static_cast<std::size_t>(j)];
    };
    for (std::size_t i = 0; i < f.size(); ++i) {
        if (f.kind[i] != InterfaceKind::faces) continue;
        const TwoFaces faces{static_cast<std::size_t>(f.block_a[i]), static_cast<std::size_t>(f.face_a[i]),
                             static_cast<std::size_t>(f.block_b[i]), static_cast<std::size_t>(f.face_b[i])};
        const std::int32_t one = model.blocks[faces.block_a].face_joint[faces.face_a];
        const std::int32_t two = model.blocks[faces.block_b].face_joint[faces.face_b];
        if (one == two || givenJoint(given, faces)) continue;
        Meeting meeting = meetingOf(joint(f.joint[i]), joint(one), joint(two));
        Names names{meeting.kept.name, meeting.other.name};
        meetings.try_emplace(std::move(names), std::move(meeting));
    }
    return meetings;
}

double tanFrictionAt(const Joint& joint, double time) { return std::tan(frictionAngleAt(joint, time)); }

/// tan(friction) of the other joint over that of the kept one.
double ratioAt(const Meeting& meeting, double time) {
    return tanFrictionAt(meeting.other, time) / tanFrictionAt(meeting.kept, time);
}

/// Both frictions are linear between the entries: their order changes at one of them, or not at all.
std::optional<double> weakestTime(const Meeting& meeting) {
    std::optional<double> weakest;
    for (const Joint* joint : {&meeting.kept, &meeting.other})
        for (const LevelPoint& point : joint->strength_over_time)
            if (isWeaker(meeting.other, meeting.kept, point.time) &&
                (!weakest || ratioAt(meeting, point.time) < (1 - kSame) * ratioAt(meeting, *weakest)))
                weakest = point.time;
    return weakest;
}

std::string frictionText(const Joint& joint, double time) {
    return "joint." + nameInFile(joint) + " has an angle of friction of " +
           formatted("%.4g", degrees(frictionAngleAt(joint, time))) + " deg";
}

Error doubtOf(const Meeting& meeting, double time) {
    const Joint& changes = changesStrength(meeting.other) ? meeting.other : meeting.kept;
    return {"joint." + nameInFile(changes) + ".strength_over_time",
            "at " + formatted("%g", time) + " s " + frictionText(meeting.other, time) + " and " +
                frictionText(meeting.kept, time) + "; between faces of both a run keeps joint." +
                nameInFile(meeting.kept) +
                ", which has less friction at time 0, and its answer may be on the unsafe side. talus storm "
                "takes the weaker joint at each time; [[interface]] gives a pair of blocks its joint"};
}

}  // namespace

std::vector<Error> weakerLater(const State& state) {
    const std::vector<Joint>& joints = state.geometry->model.joints;
    if (std::none_of(joints.begin(), joints.end(), changesStrength)) return {};
    std::map<Names, std::pair<double, Error>> worst;  // by their names in the scenario: the least ratio
    for (const auto& [names, meeting] : meetingsOf(state)) {
        const auto time = weakestTime(meeting);
        if (!time) continue;
        std::pair<double, Error> found{ratioAt(meeting, *time), doubtOf(meeting, *time)};
        const auto [place, is_new] =
            worst.try_emplace({nameInFile(meeting.kept), nameInFile(meeting.other)}, found);
        if (!is_new && found.first < place->second.first) place->second = std::move(found);
    }
    std::vector<Error> doubts;
    for (auto& each : worst) doubts.push_back(std::move(each.second.second));
    return doubts;
}

}  // namespace talus::checks
