#pragma once
// Made-up results for the tests of what `talus paper` prints and writes, and small checks of their form.

#include <string>
#include <vector>

#include "cli/text.h"
#include "reproduction/laboratory.h"
#include "reproduction/results.h"

namespace talus::tools::samples {

inline PaperCase paperCase(PaperGroup group, const std::string& name, std::vector<int> fissures,
                           double friction_deg) {
    PaperCase made;
    made.group = group;
    made.name = name;
    made.fissures = std::move(fissures);
    made.friction_deg = friction_deg;
    made.points = "vertex";
    made.water_depth = made.fissures.empty() ? 0 : 0.35;
    made.scenario.text = "# a < b & \"c\"\n";
    Model& model = made.scenario.model;
    model.stack = StackShape{
        group == PaperGroup::section5 ? 12 : 7, 5, 1, Vec3(0.2, 0.1, 0.1), Vec3::Zero(), false, {}};
    model.joints.push_back({});
    model.blocks.resize(2);
    for (Block& block : model.blocks) block.density = 2700;
    for (std::size_t i = 0; i < made.fissures.size(); ++i) {
        Water water;
        water.level = {{0, made.water_depth}};
        model.waters.push_back(water);
    }
    made.theory =
        theory::Prediction{radians(friction_deg - static_cast<double>(made.fissures.size())), false, "", ""};
    return made;
}

/// A run that found an angle: the columns in front of the first fissure slide (all of them when dry).
inline PaperRun foundRun(PaperCase what, double angle_deg) {
    PaperRun run;
    const int moving = what.fissures.empty() ? 7 : what.fissures.front();
    run.what = std::move(what);
    run.begun = true;
    run.search.status = SearchStatus::found;
    run.search.answer = radians(angle_deg);
    run.search.low = radians(angle_deg - 0.005);
    run.search.high = radians(angle_deg + 0.005);
    run.search.mode = FailureMode::sliding;
    run.search.steps = 1000;
    run.search.state_hash = 0x0123456789abcdefU;
    run.cpu_seconds = 2;
    for (int column = 1; column <= moving; ++column) {
        for (int row = 1; row <= 5; ++row) {
            BlockMotion motion;
            motion.block = "c" + std::to_string(column) + "r" + std::to_string(row) + "s1";
            motion.mode = FailureMode::sliding;
            motion.translation = Vec3(-0.01, 0, 0);
            motion.moving = true;
            run.search.moving_blocks.push_back(motion.block);
            run.search.motions.push_back(motion);
        }
    }
    return run;
}

/// Table 1 at three friction angles, section 5, three rules of contact points and one quarter case with
/// water.
inline PaperResults results() {
    PaperResults made;
    made.table_points = "vertex";
    made.wall_seconds = 12.5;
    made.threads = 2;
    made.provenance = Json{{"version", "1.2.3"}, {"scenario", nullptr}, {"command_line", "talus paper <x>"}};
    made.provenance_comments = "# version: 1.2.3\n";
    for (const LaboratorySeries& series : kLaboratory) {
        for (const double friction : kPaperFrictionDeg) {
            const std::vector<int> fissures =
                series.fissure == 0 ? std::vector<int>{} : std::vector{series.fissure};
            PaperCase what =
                paperCase(PaperGroup::table, "case-" + std::to_string(series.fissure), fissures, friction);
            what.paper_deg = series.average_deg;
            made.runs.push_back(foundRun(what, *what.paper_deg + friction - kTableFrictionDeg));
        }
    }
    made.runs.push_back(foundRun(paperCase(PaperGroup::section5, "one", {7}, 19.5), 17.83));
    made.runs.push_back(foundRun(paperCase(PaperGroup::section5, "four", {7, 8, 9, 10}, 19.5), 17.83));
    for (const std::string rule : {"quarter", "vertex", "grid 3"}) {
        PaperCase what = paperCase(PaperGroup::points, "points-" + rule, {}, 19.5);
        what.points = rule;
        what.scenario.model.points = {rule == "grid 3" ? PointRule::Kind::grid : PointRule::Kind::vertex, 3};
        made.runs.push_back(foundRun(what, rule == "vertex" ? 19.5 : 12));
    }
    made.runs.push_back(foundRun(paperCase(PaperGroup::quarter_water, "quarter-fissure-1", {1}, 19.5), 5.3));
    return made;
}

/// What is wrong with the nesting of tags and the use of < > &; empty when nothing is. Enough of XML for what
/// the program writes: elements, attributes in double quotes, one declaration; `void_tags` need no end.
inline std::string markupFault(const std::string& text, const std::vector<std::string>& void_tags) {
    std::vector<std::string> open;
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (text[at] == '&') {
            const auto end = text.find(';', at);
            const std::string name = text.substr(at + 1, end - at - 1);
            if (name != "amp" && name != "lt" && name != "gt" && name != "quot" && name != "#39")
                return "&" + name;
        }
        if (text[at] == '>') return "stray > near " + text.substr(at > 30 ? at - 30 : 0, 40);
        if (text[at] != '<') continue;
        if (text.compare(at, 6, "<style") == 0) {  // CSS, not markup
            at = text.find("</style>", at) + 7;
            continue;
        }
        std::size_t end = at + 1;
        for (bool quoted = false; end < text.size() && (quoted || text[end] != '>'); ++end) {
            if (text[end] == '"') quoted = !quoted;
            if (text[end] == '<') return "< inside a tag near " + text.substr(at, 40);
        }
        if (end >= text.size()) return "unfinished tag";
        const std::string tag = text.substr(at + 1, end - at - 1);
        at = end;
        if (tag.starts_with('?') || tag.starts_with('!')) continue;
        if (tag.starts_with('/')) {
            if (open.empty() || open.back() != tag.substr(1))
                return "</" + tag.substr(1) + "> closes nothing";
            open.pop_back();
            continue;
        }
        const std::string name = tag.substr(0, tag.find_first_of(" \n/"));
        const bool ends_itself = tag.ends_with('/');
        bool is_void = false;
        for (const std::string& known : void_tags) is_void = is_void || known == name;
        if (!ends_itself && !is_void) open.push_back(name);
    }
    return open.empty() ? "" : "<" + open.back() + "> is never closed";
}

}  // namespace talus::tools::samples
