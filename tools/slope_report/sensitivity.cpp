#include "slope_report/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "cli/scenario.h"
#include "cli/text.h"
#include "report/csv.h"
#include "report/numbers.h"
#include "report/svg.h"
#include "slope_report/stages.h"

namespace talus::tools {

namespace {

/// Strength without cohesion: the tangents of friction angles, and the factors of laws that are curves.
void changeFriction(Model& model, double factor) {
    for (Joint& joint : model.joints) {
        for (const JointProperty& property : kJointProperties) {
            if (!isReduced(joint, property) || property.unit == "Pa") continue;
            double& value = joint.*property.value;
            value = property.isAngle() ? std::atan(factor * std::tan(value)) : factor * value;
        }
    }
}

void changeStiffness(Model& model, double factor) {
    for (Joint& joint : model.joints) joint = stiffened(joint, factor);
}

SensitivityTrial trialOf(const formats::Scenario& scenario, const LoadSearch& search, const std::string& what,
                         const std::function<void(Model&)>& change, const Control& control) {
    Model model = scenario.model;
    change(model);
    const SearchResult result = valueOf(search.find(model, control, {}), scenario);
    return {what, result.status, result.answer, result.mode, result.failing_volume, result.failing_mass};
}

const char* statusWords(SearchStatus status) {
    switch (status) {
        case SearchStatus::unstable_at_start:
            return "unstable at the start of the search";
        case SearchStatus::stable_to_stop:
            return "stable to the end of the search";
        case SearchStatus::found:
        case SearchStatus::undecided:
        case SearchStatus::interrupted:
            break;
    }
    return "undecided";
}

}  // namespace

std::vector<ChangedQuantity> changedQuantities(const Model& model, Varied varied, double share) {
    const std::string percent = text(100 * share, 0) + " %";
    const auto times = [](void (*change)(Model&, double), double factor) {
        return [change, factor](Model& changed) { change(changed, factor); };
    };
    std::vector<ChangedQuantity> list{
        {"friction", "tangents of all friction angles; cohesion stays", "-" + percent, "+" + percent,
         times(changeFriction, 1 - share), times(changeFriction, 1 + share)},
        {"stiffness", "normal and shear stiffness of all joints", "-" + percent, "+" + percent,
         times(changeStiffness, 1 - share), times(changeStiffness, 1 + share)}};
    if (varied == Varied::horizontal) return list;
    const double k = model.seismic.horizontal;
    const auto with = [](double value) {
        return [value](Model& changed) { changed.seismic.horizontal = value; };
    };
    list.insert(list.begin() + 1,
                {"horizontal k", "horizontal seismic coefficient, " + text(k, 3) + " in the scenario",
                 "k = " + text(k - kSeismicStep, 3), "k = " + text(k + kSeismicStep, 3),
                 with(k - kSeismicStep), with(k + kSeismicStep)});
    return list;
}

std::optional<std::vector<Sensitivity>> sensitivities(const formats::Scenario& scenario,
                                                      const LoadSearch& search, double share,
                                                      const Control& control) {
    const auto quantities = changedQuantities(scenario.model, search.load->varied, share);
    std::vector<Sensitivity> list;
    for (std::size_t q = 0; q < quantities.size(); ++q) {
        const ChangedQuantity& changed = quantities[q];
        const double from = static_cast<double>(q), all = static_cast<double>(quantities.size());
        const auto side = [&](double part, const std::string& what,
                              const std::function<void(Model&)>& change) {
            Control its = stageOf(control, "sensitivity to " + changed.quantity, (from + part) / all,
                                  (from + part + 0.5) / all);
            its.interval = false;
            its.upper_bound = Beside::never;
            its.groups = 1;
            return trialOf(scenario, search, what, change, its);
        };
        Sensitivity both{changed.quantity, changed.change, side(0, changed.less_text, changed.less),
                         side(0.5, changed.more_text, changed.more)};
        if (control.stop != nullptr && control.stop->load()) return std::nullopt;
        list.push_back(std::move(both));
    }
    return list;
}

std::string trialText(const LoadSearch& search, const SensitivityTrial& trial) {
    if (trial.status != SearchStatus::found) return statusWords(trial.status);
    const std::string unit = *search.load->unit == '\0' ? "" : " " + std::string(search.load->unit);
    return loadFigure(search, trial.answer, search.load->decimals) + unit;
}

std::string sensitivityCsv(const std::vector<Sensitivity>& list, const LoadSearch& search,
                           const std::string& comments) {
    std::string out = comments + csvLine({"quantity", "change", "status", search.answer_key, "failure_mode",
                                          "failing_volume_m3", "failing_mass_kg"});
    for (const Sensitivity& one : list) {
        for (const SensitivityTrial* trial : {&one.less, &one.more}) {
            out += csvLine(
                {one.quantity, trial->what, toString(trial->status),
                 trial->status == SearchStatus::found ? csvNumber(trial->answer / search.load->scale) : "",
                 toString(trial->mode), csvNumber(trial->volume), csvNumber(trial->mass)});
        }
    }
    return out;
}

std::optional<Plot> sensitivityPlot(const std::vector<Sensitivity>& list, const LoadSearch& search,
                                    std::optional<double> answer, const std::string& scenario) {
    const double scale = search.load->scale;
    Plot plot{"sensitivity",
              std::filesystem::path(scenario).filename().string() + ": sensitivity",
              "The answer with each quantity less and more.",
              {},
              {}};
    Series less{"points", "dem-open", "less", {}, {}, "circle", 5}, more{"points", "dem", "more", {}};
    double low = kInfinity, high = -kInfinity;
    const auto add = [&](const SensitivityTrial& trial, double x, Series& series) {
        if (trial.status != SearchStatus::found) return;
        const double y = trial.answer / scale;
        series.add({x, y}, trial.what + ": " + trialText(search, trial));
        low = std::min(low, y), high = std::max(high, y);
    };
    for (std::size_t q = 0; q < list.size(); ++q) {
        plot.x.categories.push_back(list[q].quantity);
        add(list[q].less, static_cast<double>(q), less);
        add(list[q].more, static_cast<double>(q), more);
    }
    if (!(low <= high)) return std::nullopt;
    if (answer) {
        low = std::min(low, *answer / scale), high = std::max(high, *answer / scale);
        plot.references.push_back({'y', *answer / scale, {}, "answer", "", "the scenario as it is"});
    }
    const double margin = std::max(0.08 * (high - low), 0.01 * std::abs(high));
    plot.y = axisOver(std::string(search.answer) + (*search.load->unit == '\0' ? "" : " (\u00b0)"),
                      low - margin, high + margin, 6);
    for (std::size_t q = 0; q < list.size(); ++q) {
        const Sensitivity& one = list[q];
        if (one.less.status != SearchStatus::found || one.more.status != SearchStatus::found) continue;
        const auto x = static_cast<double>(q);
        plot.series.push_back(
            {"line", "path", "", {{x, one.less.answer / scale}, {x, one.more.answer / scale}}});
    }
    plot.series.push_back(std::move(less));
    plot.series.push_back(std::move(more));
    return plot;
}

}  // namespace talus::tools
