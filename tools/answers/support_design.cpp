#include "answers/support_design.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <functional>
#include <set>
#include <utility>

#include "cli/failures.h"
#include "cli/json.h"
#include "cli/provenance.h"
#include "cli/scenario.h"
#include "cli/text.h"
#include "talus/bolts.h"

namespace talus::tools {

namespace {

using Status = SupportDesign::Status;

constexpr int kLooks = 32;         // spacings between two that are tried for another number of bolts
constexpr double kStep = M_SQRT2;  // of spacings, until the wanted factor lies between two
constexpr double kTightest = 1.0 / 8, kWidest = 64;  // spacing over the scenario's own

bool isPattern(const std::string& field) { return field.starts_with("bolt_pattern["); }

/// A pattern's bolts are called after it: "P-1", "P-2", ...
std::string ownerOf(const Bolt& bolt) {
    return isPattern(bolt.field) ? bolt.name.substr(0, bolt.name.rfind('-')) : bolt.name;
}

/// Reads back as the same number.
std::string exact(double value) {
    char buffer[32];
    return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

class Design {
 public:
    Design(const SupportQuestion& question, const formats::Scenario& scenario, const Control& control)
        : question_(question), scenario_(scenario), control_(control) {
        findBolts();
    }

    SupportDesign run() {
        const auto begin = std::chrono::steady_clock::now();
        question_.by == DesignedBy::pretension ? findPretension() : findNumber();
        if (interrupted_) design_.status = Status::interrupted;
        if (design_.enough) writeSets();
        design_.warnings = deciding().warnings;
        design_.wall_seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        return std::move(design_);
    }

 private:
    bool isMeant(const Bolt& bolt) const { return fields_.contains(bolt.field); }

    void findBolts() {
        const bool number = question_.by == DesignedBy::number;
        std::set<double> yields;
        for (const Bolt& bolt : scenario_.model.bolts) {
            if (!question_.bolt.empty() && ownerOf(bolt) != question_.bolt) continue;
            if (number && !isPattern(bolt.field)) continue;
            fields_.insert(bolt.field);
            yields.insert(bolt.yield_force);
        }
        if (fields_.empty() || (number && fields_.size() > 1))
            throw BadInput(
                Error{"--bolt",
                      "found " + std::to_string(fields_.size()) + (number ? " patterns" : " bolts") +
                          (question_.bolt.empty() ? "" : " called \"" + question_.bolt + "\"") + " in " +
                          scenario_.path + ", allowed: " +
                          (number ? "one [[bolt_pattern]]" : "at least one [[bolt]] or [[bolt_pattern]]")});
        if (yields.size() == 1) design_.yield_force = *yields.begin();
        for (const BoltPattern& pattern : scenario_.model.bolt_patterns)
            if (number && fields_.contains(pattern.like.field)) {
                design_.spacing_along = pattern.spacing_along;
                design_.spacing_up = pattern.spacing_up;
                const auto extent = extentOf(pattern, scenario_.model);
                if (extent) design_.width = extent->along, design_.height = extent->up;
            }
    }

    // --- one trial
    // -------------------------------------------------------------------------------------------------

    /// \param amount  share of the yield force, or factor on the spacing along; 0: without these bolts
    SupportTrial trialOf(const Model& model, double amount, double up = 0) {
        SupportTrial trial{.amount = amount, .up = up, .bolts = countIn(model)};
        if (up > 0) trial.spacing_along = spacingAlong(amount), trial.spacing_up = spacingUp(up);
        Control control = control_;
        control.interval = false;
        control.upper_bound = Beside::never;
        if (control.progress)
            control.progress = [&](Progress progress) {
                progress.stage = "trial " + std::to_string(design_.trials.size() + 1) + ", " + progress.stage;
                control_.progress(progress);
            };
        SearchResult result = valueOf(safetyFactor(model, control, {}), scenario_);
        trial.status = result.status;
        if (result.status == SearchStatus::found) trial.factor = result.answer;
        if (result.status == SearchStatus::stable_to_stop) trial.factor = kInfinity;
        trial.warnings = std::move(result.warnings);
        interrupted_ = interrupted_ || result.status == SearchStatus::interrupted;
        design_.trials.push_back(trial);
        return trial;
    }

    std::size_t countIn(const Model& model) const {
        return static_cast<std::size_t>(std::count_if(model.bolts.begin(), model.bolts.end(),
                                                      [&](const Bolt& bolt) { return isMeant(bolt); }));
    }

    SupportTrial withoutBolts() {
        Model model = scenario_.model;
        std::erase_if(model.bolts, [&](const Bolt& bolt) { return isMeant(bolt); });
        return trialOf(model, 0);
    }

    SupportTrial withPretension(double share) {
        Model model = scenario_.model;
        for (Bolt& bolt : model.bolts)
            if (isMeant(bolt)) bolt.pretension = bolt.yield_force = share * bolt.yield_force;
        return trialOf(model, share);
    }

    /// A row of n bolts in a slice represents a spacing of width / n on a wide slope, with the same force per
    /// metre. A slice cannot represent spacings between these, or wider than itself.
    double spacingAlong(double factor) const {
        const double wanted = factor * design_.spacing_along;
        return design_.width / std::max(1.0, std::floor(design_.width / wanted + 1e-9));
    }
    double spacingUp(double factor) const { return std::min(factor * design_.spacing_up, design_.height); }

    Model spaced(double along, double up) const {
        Model model = scenario_.model;
        for (BoltPattern& pattern : model.bolt_patterns)
            if (fields_.contains(pattern.like.field)) {
                pattern.spacing_along = spacingAlong(along);
                pattern.spacing_up = spacingUp(up);
            }
        if (std::vector<Error> errors = placeBoltPatterns(model); !errors.empty())
            throw BadInput(formats::placed(scenario_, std::move(errors)));
        return model;
    }

    SupportTrial withSpacing(double along, double up) { return trialOf(spaced(along, up), along, up); }

    bool isEnough(const SupportTrial& trial) const { return trial.factor >= question_.factor; }

    /// False when it has no answer, and the design ends there.
    bool isSure(const SupportTrial& trial) {
        if (trial.status != SearchStatus::undecided && trial.status != SearchStatus::interrupted) return true;
        design_.status = Status::undecided;
        return false;
    }

    void take(const SupportTrial& trial) { (isEnough(trial) ? design_.enough : design_.too_little) = trial; }

    /// True when some are needed.
    bool needsSome() {
        const SupportTrial none = withoutBolts();
        if (!isSure(none)) return false;
        take(none);
        if (isEnough(none)) design_.status = Status::not_needed;
        return !isEnough(none);
    }

    // --- pretension
    // ------------------------------------------------------------------------------------------------

    /// The secant's estimate for the factor, shifted slightly to either side in turn, so that both ends
    /// converge; the middle when the secant fails.
    double nextShare(int turn) const {
        const SupportTrial &low = *design_.too_little, &high = *design_.enough;
        const double width = high.amount - low.amount;
        if (!std::isfinite(high.factor) || low.factor == 0 || turn % 4 == 3) return low.amount + 0.5 * width;
        const double line = low.amount + width * (question_.factor - low.factor) / (high.factor - low.factor);
        const double aside = (turn % 2 == 0 ? 0.4 : -0.4) * question_.tolerance;
        return std::clamp(line + aside, low.amount + 0.05 * width, high.amount - 0.05 * width);
    }

    void findPretension() {
        if (!needsSome()) return;
        const SupportTrial all = withPretension(1);
        if (!isSure(all)) return;
        take(all);
        if (!isEnough(all)) return void(design_.status = Status::not_reached);
        for (int turn = 0; design_.enough->amount - design_.too_little->amount > question_.tolerance;
             ++turn) {
            const SupportTrial trial = withPretension(nextShare(turn));
            if (!isSure(trial)) return;
            take(trial);
        }
        design_.status = Status::found;
    }

    // --- number of bolts
    // -------------------------------------------------------------------------------------------

    /// Spacings that hold more, or fewer, bolts step by step, until the factor lies between the last two.
    bool bracketSpacing() {
        SupportTrial at = withSpacing(1, 1);
        if (!isSure(at)) return false;
        take(at);
        const bool too_many = isEnough(at);
        design_.status = too_many ? Status::found : Status::not_reached;  // where no end is met
        while (isEnough(at) == too_many) {
            const double next = at.amount * (too_many ? kStep : 1 / kStep);
            if (next < kTightest || next > kWidest || (too_many && at.bolts <= 1)) return false;
            at = withSpacing(next, next);
            if (!isSure(at)) return false;
            take(at);
        }
        return true;
    }

    /// Between two spacings, one in the middle of those with another number of bolts than either; nothing
    /// when there is none.
    std::optional<double> spacingBetween() const {
        const double low = design_.enough->amount, high = design_.too_little->amount;
        std::vector<double> others;
        for (int k = 1; k < kLooks; ++k) {
            const double ratio = low * std::pow(high / low, static_cast<double>(k) / kLooks);
            const std::size_t bolts = countIn(spaced(ratio, ratio));
            if (bolts < design_.enough->bolts && bolts > design_.too_little->bolts) others.push_back(ratio);
        }
        if (others.empty()) return std::nullopt;
        return others[others.size() / 2];
    }

    void findNumber() {
        if (!needsSome() || !bracketSpacing()) return;
        while (const auto between = spacingBetween()) {
            const SupportTrial trial = withSpacing(*between, *between);
            if (!isSure(trial)) return;
            take(trial);
        }
        design_.status = Status::undecided;  // until the last of these is decided
        if (widenOneWay()) design_.status = Status::found;
    }

    /// One direction at its insufficient spacing, the other at its sufficient one: the fewer bolts first.
    /// False when undecided.
    bool widenOneWay() {
        const SupportTrial narrow = *design_.enough, wide = *design_.too_little;
        std::array<std::pair<double, double>, 2> mixed{{{narrow.amount, wide.up}, {wide.amount, narrow.up}}};
        const auto bolts = [&](const auto& way) { return countIn(spaced(way.first, way.second)); };
        if (bolts(mixed[1]) < bolts(mixed[0])) std::swap(mixed[0], mixed[1]);
        for (const auto& way : mixed) {
            if (bolts(way) <= wide.bolts || bolts(way) >= design_.enough->bolts) continue;
            const SupportTrial trial = withSpacing(way.first, way.second);
            if (!isSure(trial)) return false;
            take(trial);
            if (isEnough(trial)) break;
        }
        return true;
    }

    /// The trial that the answer names, else the last one.
    const SupportTrial& deciding() const {
        if (design_.enough) return *design_.enough;
        return design_.too_little ? *design_.too_little : design_.trials.back();
    }

    // --- what to write into the scenario
    // ---------------------------------------------------------------------------

    void writeSets() {
        const double amount = design_.enough->amount;
        if (amount == 0) return;
        if (question_.by == DesignedBy::number) {
            design_.sets = {*fields_.begin() + ".spacing[0]=" + exact(design_.enough->spacing_along),
                            *fields_.begin() + ".spacing[1]=" + exact(design_.enough->spacing_up)};
            return;
        }
        std::set<std::string> told;
        for (const Bolt& bolt : scenario_.model.bolts) {
            if (!isMeant(bolt) || !told.insert(bolt.field).second) continue;
            const std::string force = exact(amount * bolt.yield_force);
            design_.sets.push_back(bolt.field + ".pretension=" + force);
            design_.sets.push_back(bolt.field + ".yield_force=" + force);
        }
    }

    const SupportQuestion& question_;
    const formats::Scenario& scenario_;
    const Control& control_;
    std::set<std::string> fields_{};  ///< of the bolts or the pattern that are asked about
    SupportDesign design_{};
    bool interrupted_ = false;
};

// --- told
// -----------------------------------------------------------------------------------------------------------

/// The figures of an amount of support.
class Amount {
 public:
    Amount(const SupportQuestion& question, const SupportDesign& design)
        : number_(question.by == DesignedBy::number), design_(design) {}

    Json json(const SupportTrial& trial) const {
        Json json{{"bolts", trial.amount == 0 ? 0 : trial.bolts},
                  {"safety_factor", std::isfinite(trial.factor) ? number(trial.factor) : Json(nullptr)},
                  {"status", talus::toString(trial.status)}};
        if (number_ && trial.amount > 0) {
            json["spacing_m"] = {number(trial.spacing_along), number(trial.spacing_up)};
            json["bolts_in_row"] = inRow(trial);
            json["yield_force_n_per_m"] = number(forcePerMetre(trial));
        }
        if (number_) return json;
        json["share_of_yield_force"] = number(trial.amount);
        json["pretension_n"] =
            design_.yield_force > 0 ? number(trial.amount * design_.yield_force) : Json(nullptr);
        return json;
    }

    std::string text(const SupportTrial& trial) const {
        if (trial.amount == 0) return "without these bolts";
        const std::string bolts = std::to_string(trial.bolts) + (trial.bolts == 1 ? " bolt" : " bolts");
        if (number_)
            return bolts + ", " + tools::text(trial.spacing_along, 3) + " x " +
                   tools::text(trial.spacing_up, 3) + " m apart";
        const std::string share = tools::text(100 * trial.amount, 2) + " % of the yield force";
        if (design_.yield_force == 0) return bolts + " with " + share;
        return bolts + " of " + tools::text(trial.amount * design_.yield_force / 1000, 2) + " kN, " + share;
    }

    /// The amount per metre of slope, and a remark where the slice allows wider spacings; "" for pretension.
    std::string widthText(const SupportTrial& trial) const {
        if (!number_ || trial.amount == 0) return "";
        const int in_row = inRow(trial);
        return std::to_string(in_row) + " in a row " + tools::text(design_.width, 3) + " m wide, in all " +
               tools::text(forcePerMetre(trial) / 1000, 2) + " kN per metre of slope at yield" +
               (in_row > 1 ? "" : "; a wider spacing along the face needs a wider slice");
    }

 private:
    int inRow(const SupportTrial& trial) const {
        return static_cast<int>(std::lround(design_.width / trial.spacing_along));
    }
    /// At yield [N/m].
    double forcePerMetre(const SupportTrial& trial) const {
        return static_cast<double>(trial.bolts) * design_.yield_force / design_.width;
    }

    bool number_;
    const SupportDesign& design_;
};

std::string factorText(const SupportTrial& trial) {
    if (std::isinf(trial.factor)) return "stable whatever the strength";
    if (trial.status == SearchStatus::found) return "factor of safety " + text(trial.factor, 4);
    return trial.status == SearchStatus::unstable_at_start ? "unstable whatever the strength" : "undecided";
}

std::string row(std::string label, const std::string& content) {
    label.resize(std::max<std::size_t>(label.size() + 1, 18), ' ');
    return label + content + "\n";
}

std::string answerText(const SupportDesign& design, const Amount& amount) {
    switch (design.status) {
        case Status::found:
            return amount.text(*design.enough);
        case Status::not_needed:
            return "none: the factor is reached without these bolts";
        case Status::not_reached:
            return "none: the factor is not reached with " + amount.text(*design.too_little);
        case Status::interrupted:
            return "interrupted";
        case Status::undecided:
            break;
    }
    return "undecided, because the factor of safety of a trial is";
}

}  // namespace

SupportDesign designSupport(const SupportQuestion& question, const formats::Scenario& scenario,
                            const Control& control) {
    requireFreeBlock(scenario);
    return Design(question, scenario, control).run();
}

const char* toString(SupportDesign::Status status) {
    switch (status) {
        case Status::found:
            return "found";
        case Status::not_needed:
            return "not_needed";
        case Status::not_reached:
            return "not_reached";
        case Status::undecided:
            return "undecided";
        case Status::interrupted:
            break;
    }
    return "interrupted";
}

int exitCode(const SupportDesign& design) {
    if (design.status == Status::interrupted) return kInterrupted;
    return design.status == Status::undecided ? kUndecided : kDone;
}

Json supportDesignJson(const SupportQuestion& question, const SupportDesign& design,
                       const formats::Scenario& scenario, const Common& common) {
    const Amount amount(question, design);
    Json trials = Json::array();
    for (const SupportTrial& trial : design.trials) trials.push_back(amount.json(trial));
    return {{"status", toString(design.status)},
            {"wanted_factor", number(question.factor)},
            {"by", question.by == DesignedBy::number ? "number" : "pretension"},
            {"answer", design.status == Status::found ? amount.json(*design.enough) : Json(nullptr)},
            {"too_little", design.too_little ? amount.json(*design.too_little) : Json(nullptr)},
            {"set", design.sets},
            {"bolts_count_as", "active"},
            {"slice_width_m", design.width > 0 ? number(design.width) : Json(nullptr)},
            {"trials", trials},
            {"wall_seconds", number(design.wall_seconds)},
            {"warnings", warningsJson(scenario, design.warnings)},
            {"provenance", provenance(common, scenario.path)}};
}

std::string supportDesignText(const SupportQuestion& question, const SupportDesign& design,
                              const formats::Scenario& scenario) {
    const Amount amount(question, design);
    std::string lines = row("scenario", scenario.path) +
                        row("wanted", "factor of safety " + text(question.factor, 3)) +
                        row("needed", answerText(design, amount));
    if (design.enough && design.status == Status::found)
        lines += row("", factorText(*design.enough) + "; " + amount.text(*design.too_little) + ": " +
                             factorText(*design.too_little));
    if (design.enough && design.status == Status::found) {
        if (const std::string width = amount.widthText(*design.enough); !width.empty())
            lines += row("", width);
        lines += row("bolts", "active: the factor divides the strength of joints, not the bolts' forces");
    }
    for (const std::string& set : design.sets)
        lines += row(&set == &design.sets.front() ? "as" : "", "--set " + set);
    for (const SupportTrial& trial : design.trials)
        lines += row(&trial == &design.trials.front() ? "trials" : "",
                     amount.text(trial) + ": " + factorText(trial));
    for (const std::string& warning : warningsOf(scenario, design.warnings)) lines += row("warning", warning);
    return lines + row("cost", std::to_string(design.trials.size()) + " searches, " +
                                   text(design.wall_seconds, 2) + " s");
}

}  // namespace talus::tools
