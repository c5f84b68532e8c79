// The page of a report, section by section.

#include <algorithm>
#include <cmath>
#include <set>

#include "answers/factor_volume.h"
#include "answers/keyblocks_report.h"
#include "answers/search_lines.h"
#include "cli/text.h"
#include "report/html.h"
#include "slope_report/provenance_lines.h"
#include "slope_report/sections.h"
#include "slope_report/slope_report.h"

namespace talus::tools {

namespace {

using Rows = std::vector<std::vector<std::string>>;

constexpr std::size_t kNames = 4;    ///< of a moving group's blocks, before "and N more"
constexpr std::size_t kGroups = 10;  ///< moving groups of block theory that are listed

class SlopePage {
 public:
    SlopePage(const SlopeReport& report, const std::vector<ReportFigure>& figures)
        : report_(report), search_(report.search), result_(report.search.result), figures_(figures) {}

    std::string write() {
        addHead();
        addQuestion(report_, page_);
        page_.section("slope", "The slope");
        addFigure("slope");
        addAnswer();
        addGroups();
        addBeside();
        addKeyBlocks();
        addKinematicsSection();
        addWaterAndBolts(report_, page_);
        if (report_.share) addSensitivitySection();
        addWarnings();
        addProvenance();
        return page_.html("Slope report: " + fileName(report_));
    }

 private:
    static std::vector<std::pair<std::string, std::string>> items(const ResultLines& lines) {
        std::vector<std::pair<std::string, std::string>> list;
        for (const ResultLine& line : lines) list.emplace_back(line.label, line.content);
        return list;
    }

    bool addFigure(const std::string& name) {
        for (std::size_t f = 0; f < figures_.size(); ++f) {
            const ReportFigure& figure = figures_[f];
            if (figure.name != name) continue;
            page_.figure("figure-" + name, figure.svg,
                         "Figure " + std::to_string(f + 1) + ". " + figure.caption);
            return true;
        }
        return false;
    }

    void addHead() {
        const ResultLine answer = answerLines(search_).front();
        page_.paragraph(capitalised(answer.label) + ": " + answer.content, "lead");
        if (!result_.moving_blocks.empty()) {
            page_.paragraph(
                "What fails: " + amountText(result_.failing_volume, result_.failing_mass) + " in " +
                std::to_string(result_.moving_blocks.size()) + " of " +
                std::to_string(result_.motions.size()) + " free blocks, by " +
                (result_.mode == FailureMode::mixed ? "sliding and toppling" : toString(result_.mode)) + ".");
        }
        if (const std::size_t count = warnings().size(); count > 0) {
            page_.paragraph(count == 1 ? "There is a warning below."
                                       : "There are " + std::to_string(count) + " warnings below.",
                            "alert");
        }
    }

    void addAnswer() {
        page_.section("answer", "The answer");
        ResultLines lines = answerLines(search_);
        for (const ResultLines& more : {intervalLines(search_), failureLines(search_)})
            lines.insert(lines.end(), more.begin(), more.end());
        page_.facts(items(lines));
        if (!addFigure("load-displacement"))
            page_.paragraph("There is no curve of load and displacement: the search has no path.");
    }

    void addGroups() {
        page_.section("groups", "What fails, in groups");
        Rows rows;
        const auto add = [&](const std::string& what, const std::string& load, double volume, double mass,
                             const std::vector<std::string>& blocks) {
            rows.push_back({what, load, figureText(volume), figureText(mass / 1000),
                            percentText(massShare(search_.scenario.model, blocks)), blocksText(blocks)});
        };
        if (!result_.fallen_at_start.empty()) {
            const auto [volume, mass] = amountOf(result_.fallen_at_start);
            add("falls at the start", "-", volume, mass, result_.fallen_at_start);
        }
        for (const BlockGroup& group : result_.removed_groups) {
            add("fails before the answer", figureOf(search_, group.factor), group.volume, group.mass,
                group.blocks);
        }
        if (result_.groups.empty() && !result_.moving_blocks.empty()) {
            add("the answer",
                figureOf(search_, result_.status == SearchStatus::found ? result_.answer : result_.high),
                result_.failing_volume, result_.failing_mass, result_.moving_blocks);
        }
        for (const BlockGroup& group : result_.groups) {
            add(&group == &result_.groups.front() ? "the answer" : "fails next",
                figureOf(search_, group.factor), group.volume, group.mass, group.blocks);
        }
        if (rows.empty()) return page_.paragraph("No block fails up to the largest load tried.");
        page_.table("Groups of blocks in the order in which they fail",
                    {{"group", true},
                     {capitalised(search_.search.load->text) + unitOf(search_)},
                     {"m\u00b3"},
                     {"t"},
                     {"mass"},
                     {"blocks", true}},
                    rows);
        page_.paragraph("The share of the mass is that of all free blocks.", "muted");
    }

    std::pair<double, double> amountOf(const std::vector<std::string>& names) const {
        const std::set<std::string> wanted(names.begin(), names.end());
        double volume = 0, mass = 0;
        for (const Block& block : search_.scenario.model.blocks) {
            if (!wanted.contains(block.name)) continue;
            const double its = massProperties(block.shape).volume;
            volume += its, mass += block.density * its;
        }
        return {volume, mass};
    }

    void addBeside() {
        page_.section("beside", "Beside the answer");
        page_.facts(items(besideLines(search_)));
    }

    void addKeyBlocks() {
        const KeyBlockResult& found = report_.key_blocks;
        page_.section("key-blocks", "Key blocks");
        const auto removable = std::count_if(found.blocks.begin(), found.blocks.end(),
                                             [](const KeyBlock& block) { return block.removable; });
        page_.paragraph(std::to_string(removable) + " of " + std::to_string(found.blocks.size()) +
                        " free blocks are removable alone. " + std::to_string(found.groups_judged) +
                        " groups were judged by limit equilibrium, translation only: toppling is not "
                        "covered. They are judged for the scenario as it is, before "
                        "the search's load grows.");
        if (found.groups.empty()) return page_.paragraph("No group of blocks can move.");
        Rows rows;
        for (std::size_t g = 0; g < std::min(kGroups, found.groups.size()); ++g) {
            const MovingGroup& group = found.groups[g];
            rows.push_back({text(group.sliding.factor, 4), modeText(group.sliding),
                            trendPlungeText(group.sliding.direction), figureText(group.volume),
                            figureText(group.mass / 1000),
                            (group.carries.empty() ? "" : "* ") + blocksText(group.blocks, kNames)});
        }
        page_.table("Moving groups with the least factors of safety",
                    {{"factor"}, {"mode", true}, {"trend/plunge"}, {"m\u00b3"}, {"t"}, {"blocks", true}},
                    rows);
        const bool any_carries =
            std::any_of(found.groups.begin(), found.groups.begin() + static_cast<std::ptrdiff_t>(rows.size()),
                        [](const MovingGroup& group) { return !group.carries.empty(); });
        if (any_carries) {
            page_.paragraph(
                "* Blocks lean on it that cannot move with it; what they press with is not counted.",
                "muted");
        }
        addCurve();
    }

    void addCurve() {
        if (!addFigure("factor-volume")) return;
        Rows rows;
        for (const MovingGroup* group : shownPoints(report_.key_blocks)) {
            rows.push_back({figureText(group->volume), figureText(group->mass / 1000),
                            text(group->sliding.factor, 4), modeText(group->sliding),
                            std::to_string(group->blocks.size())});
        }
        page_.table("Least factor of safety of a failure of at least a volume",
                    {{"m\u00b3 or more"}, {"t"}, {"least factor"}, {"mode", true}, {"blocks"}}, rows);
    }

    void addKinematicsSection() {
        page_.section("kinematics", "Kinematics");
        if (!report_.kinematics) return page_.paragraph(report_.no_kinematics);
        addKinematicTests(*report_.kinematics, page_);
        addFigure("stereonet-poles");
        addFigure("stereonet-intersections");
    }

    void addSensitivitySection() {
        page_.section("sensitivity", "Sensitivity");
        page_.paragraph(
            "Each row changes one quantity and keeps all others. These searches look for no lower "
            "answer along another loading path.");
        Rows rows;
        for (const Sensitivity& one : report_.sensitivity) {
            rows.push_back({one.quantity + ": " + one.change, one.less.what,
                            trialText(search_.search, one.less), one.more.what,
                            trialText(search_.search, one.more)});
        }
        page_.table(
            capitalised(search_.search.answer) + " for the scenario as it is: " +
                (result_.status == SearchStatus::found ? figureOf(search_, result_.answer) + unitOf(search_)
                                                       : "none"),
            {{"quantity", true}, {"less"}, {"answer"}, {"more"}, {"answer"}}, rows);
        addFigure("sensitivity");
    }

    std::vector<std::string> warnings() const {
        std::vector<std::string> list;
        const auto add = [&](const std::vector<std::string>& more) {
            for (const std::string& warning : more)
                if (std::find(list.begin(), list.end(), warning) == list.end()) list.push_back(warning);
        };
        add(search_.scenario.warnings);
        add(result_.warnings);
        add(report_.key_blocks.warnings);
        return list;
    }

    void addWarnings() {
        page_.section("warnings", "Warnings");
        const auto list = warnings();
        if (list.empty()) return page_.paragraph("None.");
        page_.list(list);
    }

    void addProvenance() {
        page_.section("provenance", "Provenance");
        page_.facts(provenanceItems(report_));
        page_.textFile("Scenario " + fileName(report_), search_.scenario.text);
    }

    const SlopeReport& report_;
    const SearchReport& search_;
    const SearchResult& result_;
    const std::vector<ReportFigure>& figures_;
    HtmlPage page_;
};

}  // namespace

std::string slopePage(const SlopeReport& report, const std::vector<ReportFigure>& figures) {
    return SlopePage(report, figures).write();
}

}  // namespace talus::tools
