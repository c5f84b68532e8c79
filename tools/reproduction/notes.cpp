#include "reproduction/notes.h"

#include <algorithm>
#include <cmath>

#include "cli/text.h"
#include "reproduction/laboratory.h"

namespace talus::tools {
namespace {

/// The mass in front of the watered fissure: tan(beta) = tan(phi) - push(H), push = rho_w H^2 / (2 rho x h).
struct Mass {
    double length, height, density, water_density;

    double push(double depth) const {
        return water_density * depth * depth / (2 * density * length * height);
    }
    double depthOf(double push) const {
        return std::sqrt(2 * density * length * height * push / water_density);
    }
};

std::optional<Mass> massOf(const PaperCase& what) {
    const Model& model = what.scenario.model;
    const auto length = fissureDistance(what);
    if (!length || !model.stack || model.blocks.empty() || model.waters.empty()) return std::nullopt;
    return Mass{*length, model.stack->rows * model.stack->block.z(), model.blocks.back().density,
                model.waters.front().density};
}

std::string deg(std::optional<double> value, int decimals) { return shown(value, decimals) + "\u00b0"; }

/// Largest deviation from the exact limit over Table 1 and section 5, and how many cases it covers.
struct Agreement {
    std::size_t cases = 0;
    double worst = 0;
};

Agreement agreement(const PaperResults& results) {
    Agreement found;
    for (const PaperRun& run : results.runs) {
        const bool whole = run.what.group == PaperGroup::table || run.what.group == PaperGroup::section5;
        if (!whole || !lessTheory(run)) continue;
        ++found.cases;
        found.worst = std::max(found.worst, std::abs(*lessTheory(run)));
    }
    return found;
}

/// Largest difference from the laboratory over fissures 2 to 6 at Table 2's friction; nothing unless all are
/// there.
std::optional<double> worstLaboratory(const PaperResults& results) {
    std::vector<std::optional<double>> values;
    for (int fissure = 2; fissure <= 6; ++fissure) {
        const PaperRun* run = tableRun(results, fissure, kTableFrictionDeg);
        if (!run || !lessPaper(*run)) return std::nullopt;
        values.push_back(lessPaper(*run));
    }
    return largest(values);
}

Note dryNote(const PaperResults& results) {
    const PaperRun* run = tableRun(results, 0, kTableFrictionDeg);
    const double measured = kLaboratory.front().average_deg;
    return {"Dry slope: laboratory " + deg(measured, 1) + ", model " +
                deg(run ? criticalDeg(*run) : std::nullopt, 2) + " at friction angle 19.5\u00b0",
            "A dry slope slides at the friction angle of the joint that slides. The laboratory's value is "
            "therefore the friction angle of that joint, and it lies in the range of 18\u00b0 to 21\u00b0 "
            "measured on the joints. The model gives every joint the same friction angle; in the laboratory "
            "the weakest one decides."};
}

Note fissure1Note(const PaperResults& results) {
    const PaperRun* run = tableRun(results, 1, kTableFrictionDeg);
    const PaperRun* low = tableRun(results, 1, kPaperFrictionDeg.front());
    const double measured = kLaboratory[1].average_deg;
    std::string title = "Fissure 1: laboratory " + deg(measured, 1);
    if (!run) return {title, "Not computed."};
    title += ", model " + deg(criticalDeg(*run), 2);
    const auto friction = impliedFrictionDeg(run->what, measured);
    const auto depth = impliedDepth(run->what, measured);
    return {title, "Even the lower end of the measured friction angles, 18\u00b0, gives " +
                       deg(low ? criticalDeg(*low) : std::nullopt, 2) +
                       ". With water in fissure 1 a single column stands in front, and its angle is the "
                       "most sensitive of all: the measured value follows from the same formula with a "
                       "friction angle of " +
                       deg(friction, 1) + " at the stated depth of " + text(run->what.water_depth, 2) +
                       " m, or with a depth of " + shown(depth, 3) +
                       " m at 19.5\u00b0. In the laboratory the water stood at the slope's top, 0.50 m, "
                       "before the slope moved; 0.35 m is the depth reported for the limit state."};
}

Note middleNote(const PaperResults& results) {
    const auto worst = worstLaboratory(results);
    return {"Fissures 2 to 6: laboratory and model within " +
                (worst ? text(std::abs(*worst), 2) : std::string("-")) + "\u00b0",
            "At friction angle 19.5\u00b0, the value of the paper's Table 2. The friction angles the "
            "laboratory's averages imply are listed in the table; they lie within the measured range."};
}

Note section5Note(const PaperResults& results) {
    std::optional<double> one, four;
    for (const PaperRun* run : runsOf(results, PaperGroup::section5)) {
        (run->what.fissures.size() == 1 ? one : four) = criticalDeg(*run);
    }
    return {
        "Fissures 7 to 10: the paper's DEM " + deg(kPaperDemFissures7To10Deg, 1) + ", this model " +
            deg(four, 2),
        "With water in fissure 7 alone both agree (" + deg(kPaperDemFissure7Deg, 1) + " and " + deg(one, 2) +
            "). Water at the same level in fissures 8, 9 and 10 pushes with the same force on both walls of "
            "each column between them. The force on the mass in front of fissure 7 does not change, and the "
            "force on longer masses is no larger. The exact limit is therefore the same in both cases. The "
            "paper's section 5 also ends with the statement that equal water heads do not affect the angle."};
}

Note quarterNote(const PaperResults& results) {
    const PaperRun* run = pointsRun(results, "quarter");
    return {
        "The paper's contact points: dry slope " + deg(run ? criticalDeg(*run) : std::nullopt, 2) +
            " instead of 19.50\u00b0",
        "With four contact points at the centres of four equal areas a block can only turn about a line that "
        "lies a quarter of its length inside its edge. A column overturns when its weight passes that line: "
        "at atan(0.05/0.25) = 11.31\u00b0 for columns of 0.2 m by 0.5 m. Real blocks turn about their edge. "
        "Points on the edge of the interface, whether four (\"corner\") or nine (\"vertex\", the default "
        "here), slide at the friction angle, as the laboratory's slope did. The angles the paper computed "
        "itself are near the laboratory's, so they cannot come from points inside the edge."};
}

std::string laboratorySentence(const PaperResults& results) {
    const auto worst = worstLaboratory(results);
    const PaperRun* first = tableRun(results, 1, kTableFrictionDeg);
    std::string sentence;
    if (worst) {
        sentence += " At friction angle 19.5\u00b0 it lies within " + text(std::abs(*worst), 2) +
                    "\u00b0 of the laboratory\u2019s averages for fissures 2 to 6";
        sentence += first && criticalDeg(*first)
                        ? "; for fissure 1 it gives " + deg(criticalDeg(*first), 2) +
                              " where the laboratory found " + deg(kLaboratory[1].average_deg, 1) + "."
                        : ".";
    }
    return sentence;
}

}  // namespace

std::string mainResult(const PaperResults& results) {
    const Agreement found = agreement(results);
    if (found.cases == 0) return "No case was completed.";
    // Rounded up, so that "within" holds.
    const double worst = std::ceil(found.worst * 1000 - 1e-6) / 1000;
    const std::size_t all =
        runsOf(results, PaperGroup::table).size() + runsOf(results, PaperGroup::section5).size();
    const std::string which = found.cases == all
                                  ? "all " + std::to_string(all) + " cases"
                                  : std::to_string(found.cases) + " of the " + std::to_string(all) + " cases";
    return "The computed critical angle lies within " + text(worst, 3) + "\u00b0 of the exact limit in " +
           which + " of Table 1 and section 5." + laboratorySentence(results);
}

std::vector<Note> differenceNotes(const PaperResults& results) {
    return {fissure1Note(results), middleNote(results), dryNote(results), section5Note(results),
            quarterNote(results)};
}

std::vector<Note> errata() {
    return {
        {"Equations 16 and 17",
         "The last form of both carries a g too many: it cancels. Used here: K\u00a0= tan\u00a0\u03c6 / "
         "(tan\u00a0\u03b2\u00a0+ \u03c1w\u00a0y / (2\u00a0\u03c1\u00a0x)), and for a fissure filled to "
         "H behind a mass of length x and height h: tan\u00a0\u03b2 = tan\u00a0\u03c6 \u2212 "
         "\u03c1w\u00a0H\u00b2 / (2\u00a0\u03c1\u00a0x\u00a0h)."},
        {"The six percent",
         "With \u03c1 = 2.7 \u03c1w and x = 3y the tangent drops by 0.062, the paper\u2019s 0.06. That "
         "is 17 % of tan 19.5\u00b0, not 6 %: at a ratio of three the water still takes about 3\u00b0 "
         "off the critical angle when it fills the whole height."},
        {"Density", "Section 2.1 gives 2.7 kg/m\u00b3; Table 2\u2019s 2700 kg/m\u00b3 is used."},
        {"Block size",
         "Table 3 gives 20 mm \u00d7 10 mm \u00d7 10 mm; the blocks are 200 mm \u00d7 100 mm \u00d7 100 "
         "mm, as in section 2.1."},
    };
}

std::optional<double> impliedFrictionDeg(const PaperCase& what, double measured_deg) {
    if (what.fissures.empty()) return measured_deg;
    const auto mass = massOf(what);
    if (!mass) return std::nullopt;
    return degrees(std::atan(std::tan(radians(measured_deg)) + mass->push(what.water_depth)));
}

std::optional<double> impliedDepth(const PaperCase& what, double measured_deg) {
    const auto mass = massOf(what);
    const double push = std::tan(radians(what.friction_deg)) - std::tan(radians(measured_deg));
    if (!mass || push < 0) return std::nullopt;
    return mass->depthOf(push);
}

}  // namespace talus::tools
