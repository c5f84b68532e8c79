// talus inspect: the whole file, one frame, the blocks that move most, soundness, difference to another file.

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cli/block_names.h"
#include "cli/failures.h"
#include "cli/json.h"
#include "cli/text.h"
#include "inspect/views.h"
#include "recording/keep_mechanism.h"
#include "talus/searches.h"

namespace talus::tools {

namespace {

struct Motions {
    std::vector<double> displacement, velocity, rotation;  ///< per block [m, m/s, rad]
};

Motions motionsOf(const LightFrame& frame) {
    Motions motions;
    for (std::size_t b = 0; b < frame.displacement.x.size(); ++b) {
        motions.displacement.push_back(get(frame.displacement, b).norm());
        motions.velocity.push_back(get(frame.velocity, b).norm());
        motions.rotation.push_back(get(frame.rotation, b).norm());
    }
    return motions;
}

std::size_t largest(const std::vector<double>& values) {
    return static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
}

/// One row a frame: the course of a run.
Table courseOf(formats::SnapshotReader& reader) {
    Table table;
    table.columns = {"frame",
                     "time_s",
                     "step",
                     "full",
                     "tilt_deg",
                     "kinetic_energy_j",
                     "elastic_energy_j",
                     "gravity_energy_j",
                     "out_of_balance",
                     "largest_displacement_m",
                     "largest_velocity_m_s",
                     "state_hash"};
    for (std::size_t k = 0; k < reader.frames().size(); ++k) {
        const LightFrame frame = valueOf(reader.frame(k));
        const Motions m = motionsOf(frame);
        const auto most = [](const std::vector<double>& values) {
            return number(values.empty() ? 0 : values[largest(values)]);
        };
        table.rows.push_back({k, number(frame.time), frame.step, reader.frames()[k].full.has_value(),
                              number(degrees(frame.tilt)), number(frame.kinetic_energy),
                              number(frame.elastic_energy), number(frame.gravity_energy),
                              number(frame.out_of_balance), most(m.displacement), most(m.velocity),
                              hashText(frame.state_hash)});
    }
    return table;
}

std::string endOf(const formats::SnapshotReader& reader) {
    const auto end = reader.end();
    return end ? end->ended : "not finished: the run is still going on or was killed";
}

Json buildJson(const BuildInfo& build) {
    return {{"version", build.version},
            {"git_hash", build.git_hash},
            {"compiler", build.compiler},
            {"instruction_set", build.instruction_set},
            {"build_type", build.build_type}};
}

/// Results of the search that kept this run.
Json failureJson(const formats::SnapshotHeader& header) {
    const formats::SnapshotFailure& failure = *header.failure;
    std::vector<std::string> slides, topples;
    for (std::size_t b = 0; b < failure.roles.size(); ++b) {
        if (failure.roles[b] == FailureMode::sliding) slides.push_back(header.names[b]);
        if (failure.roles[b] == FailureMode::toppling) topples.push_back(header.names[b]);
    }
    const LoadSearch* search = loadSearch(failure.analysis);
    // nullptr: of a later version
    const VariedQuantity* load = search ? search->load : mechanismLoad(failure.analysis);
    const double scale = load ? load->scale : 1;
    Json json{{"analysis", failure.analysis},
              {load ? load->key : "load", number(failure.load / scale)},
              {"mode", toString(failure.mode)},
              {"slides", compactNames(slides)},
              {"topples", compactNames(topples)}};
    if (failure.path.empty()) return json;
    json["answer"] = number(failure.answer / scale);
    json["bracket"] = {number(failure.stands / scale), number(failure.fails / scale)};
    json["path"] = Json::array();
    for (const PathPoint& point : failure.path)
        json["path"].push_back(
            {{"load", number(point.load / scale)}, {"displacement_m", number(point.displacement)}});
    return json;
}

/// Its law and the numbers of that law, as a scenario has them.
Json jointJson(const Joint& joint) {
    Json json = {{"joint", joint.name}, {"law", toString(joint.law)}};
    for (const JointProperty& property : kJointProperties)
        if (property.laws.has(joint.law))
            json[std::string(property.key)] = number(joint.*property.value / property.toSi());
    if (joint.law != StrengthLaw::envelope) return json;
    for (const EnvelopePoint& point : joint.shear_strength)
        json["shear_strength"].push_back({number(point.normal_stress), number(point.shear_strength)});
    return json;
}

std::size_t count(const formats::SnapshotHeader& header, Motion motion) {
    return static_cast<std::size_t>(std::count(header.motions.begin(), header.motions.end(), motion));
}

}  // namespace

View viewSummary(formats::SnapshotReader& reader, const std::string& path) {
    const formats::SnapshotHeader& header = reader.header();
    const auto& frames = reader.frames();
    View view;
    view.title = path;
    Json& facts = view.facts;
    facts["scenario"] = header.scenario_path;
    facts["blocks"] = header.names.size();
    facts["fixed_blocks"] = count(header, Motion::fixed);
    facts["driven_blocks"] = count(header, Motion::driven);
    facts["joints"] = header.joints.size();
    facts["joint_laws"] = Json::array();
    for (const Joint& joint : header.joints)
        if (joint.law != StrengthLaw::coulomb) facts["joint_laws"].push_back(jointJson(joint));
    facts["waters"] = header.waters.size();
    if (reader.fulls() > 0) {
        if (const auto full = reader.full(reader.fulls() - 1); full) {
            const FrameInterfaces& f = full->interfaces;
            std::size_t idle = 0;
            for (std::size_t i = 0; i < f.size(); ++i) idle += f.isIdle(i) ? 1 : 0;
            facts["interfaces"] = f.size() - idle;
            facts["idle_interfaces"] = idle;
            facts["contact_points"] = full->points.size() - idle;  // an idle one has one Lp
        }
    }
    facts["frames"] = frames.size();
    facts["full_states"] = reader.fulls();
    facts["frame_interval_s"] = number(header.frame_interval);
    facts["duration_s"] = number(header.duration);
    facts["reached_s"] = frames.empty() ? Json(nullptr) : number(frames.back().time);
    facts["ended"] = endOf(reader);
    const auto end = reader.end();
    if (!frames.empty()) {
        if (const auto last = reader.frame(frames.size() - 1); last) {
            facts["steps"] = last->step;
            facts["state_hash"] = hashText(last->state_hash);
        }
    }
    facts["wall_seconds"] = end ? number(end->wall_seconds) : Json(nullptr);
    facts["warnings"] = end ? Json(end->warnings) : Json::array();
    facts["faults"] = reader.faults();
    facts["bytes"] = reader.fileSize();
    facts["build"] = buildJson(header.build);
    facts["command_line"] = header.command_line;
    facts["format"] = header.format;
    facts["failure"] = header.failure ? failureJson(header) : Json(nullptr);
    view.table_name = "course";
    view.table = courseOf(reader);
    return view;
}

View viewFrame(formats::SnapshotReader& reader, std::size_t index) {
    const LightFrame frame = valueOf(reader.frame(index));
    const Motions m = motionsOf(frame);
    const auto& names = reader.header().names;
    View view;
    view.title = "frame " + std::to_string(index);
    view.facts = {{"frame", index},
                  {"time_s", number(frame.time)},
                  {"step", frame.step},
                  {"full", reader.frames()[index].full.has_value()},
                  {"state_hash", hashText(frame.state_hash)},
                  {"tilt_deg", number(degrees(frame.tilt))},
                  {"time_step_s", number(frame.time_step)},
                  {"kinetic_energy_j", number(frame.kinetic_energy)},
                  {"elastic_energy_j", number(frame.elastic_energy)},
                  {"gravity_energy_j", number(frame.gravity_energy)},
                  {"out_of_balance", number(frame.out_of_balance)}};
    if (!names.empty()) {
        view.facts["farthest_block"] = names[largest(m.displacement)];
        view.facts["farthest_displacement_m"] = number(m.displacement[largest(m.displacement)]);
        view.facts["fastest_block"] = names[largest(m.velocity)];
        view.facts["fastest_velocity_m_s"] = number(m.velocity[largest(m.velocity)]);
    }
    view.table_name = "waters";
    view.table.columns = {"water", "level_m", "table_elevation_m", "drained"};
    for (std::size_t w = 0; w < frame.water.level.size(); ++w)
        view.table.rows.push_back({reader.header().waters[w].field, number(frame.water.level[w]),
                                   number(frame.water.table[w]), frame.water.drained[w] != 0});
    return view;
}

View viewTop(formats::SnapshotReader& reader, std::size_t index, std::size_t top, const std::string& by) {
    const LightFrame frame = valueOf(reader.frame(index));
    const Motions m = motionsOf(frame);
    const std::vector<double>& key = by == "velocity"   ? m.velocity
                                     : by == "rotation" ? m.rotation
                                                        : m.displacement;
    std::vector<std::size_t> order(key.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return key[a] > key[b]; });
    order.resize(std::min(order.size(), top));
    View view;
    view.title = "frame " + std::to_string(index) + ", by " + by;
    view.facts = {{"frame", index}, {"time_s", number(frame.time)}, {"by", by}};
    view.table_name = "top";
    view.table.columns = {"block", "displacement_m", "velocity_m_s", "rotation_deg", "dx_m", "dy_m", "dz_m"};
    for (const std::size_t b : order) {
        const Vec3 moved = get(frame.displacement, b);
        view.table.rows.push_back({reader.header().names[b], number(m.displacement[b]), number(m.velocity[b]),
                                   number(degrees(m.rotation[b])), number(moved.x()), number(moved.y()),
                                   number(moved.z())});
    }
    return view;
}

View viewVerify(formats::SnapshotReader& reader) {
    const std::vector<std::string> faults = reader.verify();
    View view;
    view.title = faults.empty() ? "all checksums and hashes are correct" : "not sound";
    view.facts = {{"sound", faults.empty()},
                  {"frames", reader.frames().size()},
                  {"full_states", reader.fulls()},
                  {"ended", endOf(reader)}};
    view.table_name = "faults";
    view.table.columns = {"fault"};
    for (const std::string& fault : faults) view.table.rows.push_back({fault});
    return view;
}

namespace {

struct Comparison {
    std::optional<formats::Difference> first;
    std::size_t frame = 0;   ///< of the first file, where they differ
    std::size_t common = 0;  ///< frames of the same instant that were compared
    std::size_t only_here = 0, only_there = 0;
};

/// Frames of the same instant, light before full, up to the first that differ. An interrupted run has a frame
/// that the other one lacks. Frames in one file only are counted, and are no difference as long as others are
/// common.
Comparison compare(formats::SnapshotReader& a, formats::SnapshotReader& b) {
    Comparison result;
    std::size_t i = 0, j = 0;
    const auto &here = a.frames(), &there = b.frames();
    while (i < here.size() && j < there.size() && !result.first) {
        if (here[i].time != there[j].time) {
            here[i].time < there[j].time ? (++i, ++result.only_here) : (++j, ++result.only_there);
            continue;
        }
        result.frame = i;
        result.first = formats::firstDifference(valueOf(a.frame(i)), valueOf(b.frame(j)));
        if (!result.first && here[i].full && there[j].full) {
            result.first =
                formats::firstDifference(valueOf(a.full(*here[i].full)), valueOf(b.full(*there[j].full)));
            if (result.first) result.first->field = "full." + result.first->field;
        }
        ++i, ++j, ++result.common;
    }
    if (result.first) return result;
    result.only_here += here.size() - i, result.only_there += there.size() - j;
    if (result.common <= 1 && result.only_here + result.only_there > 0)
        result.first = formats::Difference{"time", "frames at other times", "frames at other times"};
    return result;
}

}  // namespace

View viewDifference(formats::SnapshotReader& reader, formats::SnapshotReader& other,
                    const std::string& other_path) {
    View view;
    const bool same_scenario = reader.header().scenario_text == other.header().scenario_text;
    const bool same_blocks = reader.header().names == other.header().names;
    const Comparison found = same_blocks ? compare(reader, other) : Comparison{};
    const bool equal = same_blocks && !found.first;
    view.title = equal ? "equal to the bit in all frames that both have" : "they differ";
    view.facts = {{"other", other_path},
                  {"same_scenario", same_scenario},
                  {"same_blocks", same_blocks},
                  {"equal", equal},
                  {"common_frames", found.common},
                  {"frames_only_here", found.only_here},
                  {"frames_only_there", found.only_there}};
    if (!found.first) return view;
    view.facts["frame"] = found.frame;
    view.facts["time_s"] = number(reader.frames()[found.frame].time);
    view.facts["field"] = found.first->field;
    view.facts["here"] = found.first->a;
    view.facts["there"] = found.first->b;
    return view;
}

}  // namespace talus::tools
