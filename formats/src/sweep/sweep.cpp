// Sweep files: the order of reading, and the trial of every value before the first run.

#include "talus/formats/sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "sweep/correlation.h"
#include "sweep/questions.h"
#include "sweep/runs.h"
#include "sweep/variables.h"
#include "toml/document.h"
#include "toml/field_path.h"
#include "toml/file_text.h"
#include "toml/table_reader.h"
#include "toml/wording.h"

namespace talus::formats {

namespace sweep {
namespace {

using namespace toml;

constexpr std::size_t kMaxTried = 1000;  // values of one variable that are tried in advance
constexpr double kNearlyCertain = 1e-9;  // share of a distribution beyond the ends that are tried
constexpr std::int64_t kMaxSamples = 1'000'000'000;
constexpr std::int64_t kMostGroups = 1000;  // as of a single search
constexpr std::uint64_t kMaxRuns = 1'000'000'000'000;

scenario::KnownNames knownNames(const Scenario& scenario) {
    scenario::KnownNames names{.joints = {}, .materials = scenario.materials};
    for (std::size_t j = 0; j < scenario.joint_origins.size(); ++j)
        if (scenario.joint_origins[j].kind == JointOrigin::Kind::file)
            names.joints.push_back(scenario.model.joints[j].name);
    return names;
}

class SweepReader {
 public:
    /// \param scenario  in place of the file that is named, when not null
    SweepReader(Report& report, Node root, const std::string& path,
                std::shared_ptr<const Scenario> scenario = nullptr)
        : report_(report),
          root_(report, root, "",
                {"format", "scenario", "analysis", "range", "groups", "samples", "seed", "sampling", "grid",
                 "table", "random", "correlation", "report"}),
          base_(std::move(scenario)) {
        sweep_.path = path;
    }

    Result<Sweep> read() {
        root_.integer("format", {1, 1});
        root_.require({"scenario", "analysis"});
        const scenario::KnownNames known = readScenarioText();
        if (!errors_.empty()) return errors_;
        readAnalysis();
        Variables variables = readVariables(report_, root_, sweep_.path, known);
        readCorrelation(report_, root_, variables.list);
        readSampling(variables);
        readReport();
        if (!variables.errors.empty() || !report_.clean()) {
            errors_ = report_.clean() ? std::vector<Error>{} : report_.errors();
            errors_.insert(errors_.end(), variables.errors.begin(), variables.errors.end());
            return errors_;
        }
        keep(variables);
        tryValues(variables.list);
        if (!errors_.empty()) return errors_;
        if (!report_.clean()) return report_.errors();
        return std::move(sweep_);
    }

 private:
    /// The scenario has to be good as it is.
    scenario::KnownNames readScenarioText() {
        const auto name = root_.text("scenario");
        if (base_) {
            sweep_.scenario_text = base_->text;
            return knownNames(*base_);
        }
        if (!name) return {};
        sweep_.scenario_path = besideFile(sweep_.path, *name);
        const auto text = readFileText(sweep_.scenario_path);
        auto scenario = text ? parseScenario(*text, sweep_.scenario_path) : Result<Scenario>(text.errors());
        if (!scenario) {
            errors_ = scenario.errors();
            return {};
        }
        sweep_.scenario_text = std::move(scenario->text);
        base_ = std::make_shared<const Scenario>(*std::move(scenario));
        return knownNames(*base_);
    }

    void readSampling(const Variables& variables) {
        const bool is_random = std::any_of(
            variables.list.begin(), variables.list.end(),
            [](const Variable& variable) { return variable.column.source == SweepSource::random; });
        const bool has_random = is_random || root_.has("random");
        if (has_random)
            root_.require({"samples"});
        else
            for (const char* key : {"samples", "seed", "sampling"})
                if (root_.has(key))
                    root_.error(key, "found without [[random]], allowed: only with random variables");
        sweep_.samples = static_cast<std::uint64_t>(root_.integer("samples", {1, kMaxSamples}).value_or(1));
        sweep_.seed = static_cast<std::uint64_t>(
            root_.integer("seed", {0, std::numeric_limits<std::int64_t>::max()}).value_or(1));
        sweep_.latin_hypercube = root_.choice("sampling", {"random", "latin-hypercube"}).value_or(0) == 1;
    }

    void readAnalysis() {
        std::vector<std::string> names;
        for (const LoadSearch& search : loadSearches()) names.push_back(search.name);
        names.push_back("run");
        const std::size_t chosen = root_.choice("analysis", names).value_or(0);
        sweep_.search = chosen < loadSearches().size() ? &loadSearches()[chosen] : nullptr;
        sweep_.tries_histories = root_.boolean("range").value_or(false);
        if (sweep_.tries_histories && !sweep_.search)
            root_.error("range", "found with analysis = \"run\", allowed: only with a search");
        sweep_.groups = static_cast<int>(root_.integer("groups", {1, kMostGroups}).value_or(1));
        if (root_.has("groups") && (sweep_.search == nullptr || !sweep_.search->follows_groups))
            root_.error("groups", "found with another analysis, allowed: with \"safety-factor\"");
    }

    void readReport() {
        std::vector<std::string> keys{"confidence"};
        for (const LoadSearch& search : loadSearches()) keys.push_back(search.load->key);
        auto table = root_.table("report", keys);
        if (!table) return;
        constexpr Interval kConfidence{0.5, 1, false, true};
        sweep_.report.confidence = table->number("confidence", kConfidence).value_or(0.95);
        for (const LoadSearch& search : loadSearches()) {
            const Interval range{search.lowest, search.highest, true, std::isfinite(search.highest)};
            auto thresholds = table->numbers(search.load->key, range, std::nullopt);
            if (&search == sweep_.search && thresholds) sweep_.report.thresholds = std::move(*thresholds);
            if (&search != sweep_.search && table->has(search.load->key))
                table->error(search.load->key, "found with another analysis, allowed: with \"" +
                                                   std::string(search.name) + "\"");
        }
    }

    /// \pre nothing is wrong so far
    void keep(const Variables& variables) {
        sweep_.case_names = variables.case_names;
        std::uint64_t rows = std::max<std::uint64_t>(1, variables.case_names.size()), grids = 1;
        for (const Variable& variable : variables.list) {
            sweep_.columns.push_back(variable.column);
            if (variable.column.source == SweepSource::table) rows = variable.column.values.size();
            if (variable.column.source != SweepSource::grid) continue;
            grids *= variable.column.values.size();
            if (grids > kMaxRuns) break;
        }
        sweep_.cases = rows * grids;
        if (sweep_.cases > kMaxRuns || sweep_.runs() > kMaxRuns)
            root_.error("", "found a sweep of more than 10^12 runs, allowed: at most that many");
    }

    // --- the trial
    // ----------------------------------------------------------------------------------------------

    void tryValues(const std::vector<Variable>& list) {
        if (!report_.clean()) return;
        prepareRuns(sweep_, base_);
        SweepRun first = runOf(sweep_, 0);
        for (std::size_t c = 0; c < list.size(); ++c)
            if (list[c].column.source == SweepSource::random && list[c].column.per != SampledPer::interface)
                first.values[c] = drawnValue(list[c].column.distribution, 0.5);
        if (!tryRun(first, list, nullptr, 0)) return;
        for (std::size_t c = 0; c < list.size() && errors_.empty(); ++c) tryVariable(first, list, c);
        tryRows(first, list);
    }

    void tryVariable(const SweepRun& first, const std::vector<Variable>& list, std::size_t c) {
        const SweepColumn& column = list[c].column;
        if (column.source == SweepSource::table) return;
        SweepRun run = first;
        if (column.source == SweepSource::grid) {
            for (std::size_t i = 1; i < std::min(column.values.size(), kMaxTried); ++i) {
                run.values[c] = column.values[i];
                tryRun(run, list, &list[c], i);
            }
            return;
        }
        const auto kind = column.distribution.kind;
        if (kind == Distribution::Kind::normal || kind == Distribution::Kind::lognormal) return;
        for (const double share : {kNearlyCertain, 1 - kNearlyCertain}) {
            const SweepValue value = drawnValue(column.distribution, share);
            if (column.per == SampledPer::interface) {
                // Every interface alike stands for the one that drew this value.
                SweepRun all = first;
                Sweep like = sweep_;
                like.columns[c].per = SampledPer::run;
                like.base_pairs = nullptr;
                all.values[c] = value;
                check(scenarioOf(like, all), list, &list[c], 0);
            } else {
                run.values[c] = value;
                tryRun(run, list, &list[c], 0);
            }
        }
    }

    void tryRows(const SweepRun& first, const std::vector<Variable>& list) {
        const auto of_table = [](const Variable& v) { return v.column.source == SweepSource::table; };
        const auto column = std::find_if(list.begin(), list.end(), of_table);
        if (column == list.end()) return;
        for (std::size_t row = 1; row < std::min(column->column.values.size(), kMaxTried); ++row) {
            SweepRun run = first;
            for (std::size_t c = 0; c < list.size(); ++c)
                if (of_table(list[c])) run.values[c] = list[c].column.values[row];
            tryRun(run, list, &*column, row);
        }
    }

    bool tryRun(const SweepRun& run, const std::vector<Variable>& list, const Variable* suspect,
                std::size_t value) {
        return check(scenarioOf(sweep_, run), list, suspect, value);
    }

    /// The sweep's value that made a scenario invalid: the one whose field the reader's error names, else the
    /// one changed last.
    bool check(const Result<SampledScenario>& scenario, const std::vector<Variable>& list,
               const Variable* suspect, std::size_t value) {
        for (const Error& error : scenario.errors()) {
            const Variable* variable = suspect;
            for (const Variable& candidate : list)
                for (const std::string& target : candidate.column.targets)
                    if (error.field == target) variable = &candidate;
            addError(error, variable, variable == suspect || isTable(variable) ? value : 0);
        }
        return scenario.ok();
    }

    static bool isTable(const Variable* variable) {
        return variable && variable->column.source == SweepSource::table;
    }

    void addError(const Error& error, const Variable* variable, std::size_t value) {
        const std::string message = "gives a scenario with " + error.field + ": " + error.message;
        if (!variable) {
            errors_.push_back({error.field, error.message + " (with the sweep's first values)",
                               sweep_.scenario_path, error.line, error.column});
            return;
        }
        const Place place = value < variable->places.size() ? variable->places[value] : variable->place;
        errors_.push_back({variable->field, message, variable->file.empty() ? sweep_.path : variable->file,
                           place.line, place.column});
    }

    Report& report_;
    TableReader root_;
    Sweep sweep_;
    std::shared_ptr<const Scenario> base_;
    std::vector<Error> errors_;
};

}  // namespace
}  // namespace sweep

std::string toString(const SweepValue& value) {
    if (const auto* text = std::get_if<std::string>(&value)) return *text;
    if (const auto* boolean = std::get_if<bool>(&value)) return *boolean ? "true" : "false";
    if (const auto* integer = std::get_if<std::int64_t>(&value)) return std::to_string(*integer);
    return toml::numberText(std::get<double>(value));
}

void sweep::questionsOf(const toml::Document& document, const Scenario& scenario,
                        toml::Questions& questions) {
    toml::Report report("");
    report.listen(&questions);
    report.add({}, "", "what is asked has no answer");  // so that nothing is tried
    sweep::SweepReader(report, document.root(), "", std::make_shared<const Scenario>(scenario)).read();
}

Result<Sweep> readSweep(const std::string& path) {
    const auto text = toml::readFileText(path);
    return text ? parseSweep(*text, path) : text.errors();
}

Result<Sweep> parseSweep(const std::string& text, const std::string& path,
                         std::shared_ptr<const Scenario> scenario) {
    const auto document = toml::Document::parse(text, path);
    if (!document) return document.errors();
    toml::Report report(path);
    auto sweep = sweep::SweepReader(report, document->root(), path, std::move(scenario)).read();
    if (sweep) sweep->text = text;
    return sweep;
}

}  // namespace talus::formats
