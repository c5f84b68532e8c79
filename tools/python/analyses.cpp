// Analyses, runs and batches: the computations and the JSON of the command line, called from Python.

#include <pybind11/stl.h>

#include <algorithm>

#include "answers/keyblocks_report.h"
#include "answers/limit_report.h"
#include "answers/run_report.h"
#include "answers/search.h"
#include "answers/search_plot.h"
#include "answers/storm.h"
#include "batch/outcome.h"
#include "cli/json.h"
#include "cli/scenario.h"
#include "python/computing.h"
#include "python/module.h"
#include "report/numbers.h"
#include "report/svg.h"

namespace talus::python {

namespace {

using namespace tools;

Common commonOf(const Manner& manner) { return {.json = true, .quiet = true, .threads = manner.threads}; }

struct SearchOptions {
    int groups = 1;
    py::object ceiling = py::none();  ///< True, False, or None: by the model's size
    py::object range = py::none();    ///< False: no interval
    std::string keep_run;
    std::optional<double> keep_run_seconds;
    bool force = false;
    SearchFiles files{};
};

/// Of True, False, or None.
Beside besideOf(const py::object& wish) {
    if (wish.is_none()) return Beside::by_size;
    return wish.cast<bool>() ? Beside::always : Beside::never;
}

std::string search(const std::string& name, const formats::Scenario& scenario, const SearchOptions& options,
                   const Manner& manner) {
    const LoadSearch* wanted = loadSearch(name);
    if (wanted == nullptr) throw BadInput(Error{"search", "there is no search \"" + name + "\""});
    SearchRequest request{.groups = options.groups,
                          .keep = {options.keep_run, options.keep_run_seconds, options.force},
                          .files = options.files};
    request.upper_bound = besideOf(options.ceiling);
    request.interval = options.range.is_none() || options.range.cast<bool>();
    std::string json;
    compute(manner, [&](Computing& computing) {
        const Common common = commonOf(manner);
        json = jsonText(searchJson(answer(*wanted, scenario, request, common, computing.control())));
    });
    return json;
}

/// The curve of a search's result, as SVG; "" of one without a curve.
std::string curve(const std::string& result_json) {
    const Json json = Json::parse(result_json);
    const auto searches = loadSearches();
    const auto search = std::find_if(searches.begin(), searches.end(),
                                     [&](const LoadSearch& each) { return json.contains(each.answer_key); });
    if (search == searches.end() || !json.contains("path") || json["path"].empty()) return "";
    const auto load = [&](const Json& value) {
        return value.is_number() ? value.get<double>() * search->load->scale : kInfinity;
    };
    SearchResult result;
    for (const Json& point : json["path"])
        result.path.push_back({load(point["load"]), point["displacement_m"].get<double>()});
    for (const Json& probe : json.value("probe_list", Json::array()))
        result.probes.emplace_back().verdict =
            probe["verdict"] == toString(Verdict::failing) ? Verdict::failing : Verdict::stable;
    if (json[search->answer_key].is_number()) {
        result.status = SearchStatus::found;
        result.answer = load(json[search->answer_key]);
        result.low = load(json[search->keyInUnit("bracket")][0]);
        result.high = load(json[search->keyInUnit("bracket")][1]);
    }
    const double failure = json.value("failure_displacement_m", 0.0);
    const std::string scenario = json.value(Json::json_pointer("/provenance/scenario"), std::string());
    return svgFile(searchPlot(*search, result, scenario, failure), true);
}

std::string limit(const formats::Scenario& scenario, const std::string& load, std::size_t max_points,
                  const Manner& manner) {
    const VariedQuantity* quantity = variedNamed(load);
    if (quantity == nullptr) {
        std::string names;
        for (const VariedQuantity& known : variedQuantities())
            names += (names.empty() ? "\"" : ", \"") + std::string(known.name) + "\"";
        throw BadInput(Error{"load", "found \"" + load + "\", allowed: " + names});
    }
    requireFreeBlock(scenario);
    LimitSettings settings;
    settings.max_contact_points = max_points;
    std::string json;
    compute(manner, [&](Computing& computing) {
        const LimitResult result = tools::valueOf(
            limitAnalysis(scenario.model, quantity->varied, computing.control(), settings), scenario);
        json = jsonText(limitJson(*quantity, result, commonOf(manner), scenario));
    });
    return json;
}

std::string blockTheory(const formats::Scenario& scenario, std::size_t most, const Manner& manner) {
    if (most < 1) throw BadInput(Error{"most", "found 0, allowed: 1 or more groups"});
    requireFreeBlock(scenario);
    std::string json;
    compute(manner, [&](Computing& computing) {
        const KeyBlockResult result =
            tools::valueOf(keyBlocks(scenario.model, computing.control(), {.most_groups = most}), scenario);
        json = jsonText(keyBlocksJson(result, commonOf(manner), scenario));
    });
    return json;
}

std::string overRain(const formats::Scenario& scenario, const StormRequest& request, const Manner& manner) {
    std::string json;
    compute(manner, [&](Computing& computing) {
        const Common common = commonOf(manner);
        json = jsonText(stormJson(stormOf(scenario, request, common, computing.control()), scenario, common));
    });
    return json;
}

std::string timeHistory(const formats::Scenario* scenario, const std::string& output,
                        const std::string& resume, int full_every, bool force, const Manner& manner) {
    std::string json;
    compute(manner, [&](Computing& computing) {
        const RunOptions options{.common = commonOf(manner),
                                 .scenario = {scenario != nullptr ? scenario->path : "", {}},
                                 .output = output,
                                 .resume = resume,
                                 .force = force,
                                 .frames_per_full = full_every,
                                 .output_option = "output",
                                 .give_up = [&] { computing.requestStop(); }};
        std::optional<Resumed> resumed;
        if (scenario == nullptr) resumed.emplace(readResumed(options));
        const formats::Scenario& of = resumed ? resumed->scenario : *scenario;
        RunRecorder recorder(options, of, resumed ? &*resumed : nullptr);
        const RunResult result =
            runRecorded(of, resumed ? &resumed->from : nullptr, recorder, computing.control());
        json = jsonText(runJson(options, of, result, recorder));
    });
    return json;
}

std::string batchRuns(const std::string& sweep_path, const std::string& folder, bool retry,
                      const Manner& manner) {
    std::string json;
    compute(manner, [&](Computing& computing) {
        const formats::Sweep sweep = tools::valueOf(formats::readSweep(sweep_path));
        const batch::BatchRequest request{
            .common = commonOf(manner),
            .sweep = sweep_path,
            .folder = folder,
            .retry = retry,
            .abandon = [&] { computing.requestStop(); },
            .progress = [&](const Progress& progress) { computing.report(progress); }};
        json = jsonText(batchJson(batch::computeBatch(sweep, request, computing.stop()), request));
    });
    return json;
}

}  // namespace

void addAnalyses(py::module_& module) {
    module.def(
        "search",
        [](const std::string& name, const formats::Scenario& scenario, int groups, const py::object& ceiling,
           const py::object& range, const std::string& keep_run, std::optional<double> keep_run_seconds,
           bool force, const std::string& plot, const std::string& picture, const py::object& threads,
           const py::object& progress) {
            return search(name, scenario,
                          {groups, ceiling, range, keep_run, keep_run_seconds, force, {plot, picture}},
                          {threadsOf(threads), progress});
        },
        py::arg("name"), py::arg("scenario"), py::kw_only(), py::arg("groups"), py::arg("ceiling"),
        py::arg("range"), py::arg("keep_run"), py::arg("keep_run_seconds"), py::arg("force"), py::arg("plot"),
        py::arg("picture"), py::arg("threads"), py::arg("progress"));
    module.def("curve", curve, py::arg("result_json"));
    module.def(
        "limit_analysis",
        [](const formats::Scenario& scenario, const std::string& load, std::size_t max_points,
           const py::object& threads, const py::object& progress) {
            return limit(scenario, load, max_points, {threadsOf(threads), progress});
        },
        py::arg("scenario"), py::kw_only(), py::arg("load"), py::arg("max_points"), py::arg("threads"),
        py::arg("progress"));
    module.def(
        "keyblocks",
        [](const formats::Scenario& scenario, std::size_t most, const py::object& threads,
           const py::object& progress) {
            return blockTheory(scenario, most, {threadsOf(threads), progress});
        },
        py::arg("scenario"), py::kw_only(), py::arg("most"), py::arg("threads"), py::arg("progress"));
    module.def(
        "storm",
        [](const formats::Scenario& scenario, double step, std::optional<double> duration,
           const std::string& plot, const std::string& csv, const py::object& threads,
           const py::object& progress) {
            return overRain(scenario, {{step, duration}, plot, csv}, {threadsOf(threads), progress});
        },
        py::arg("scenario"), py::kw_only(), py::arg("step"), py::arg("duration"), py::arg("plot"),
        py::arg("csv"), py::arg("threads"), py::arg("progress"));
    module.def(
        "run",
        [](const formats::Scenario* scenario, const std::string& output, const std::string& resume,
           int full_every, bool force, const py::object& threads, const py::object& progress) {
            return timeHistory(scenario, output, resume, full_every, force, {threadsOf(threads), progress});
        },
        py::arg("scenario"), py::kw_only(), py::arg("output"), py::arg("resume"), py::arg("full_every"),
        py::arg("force"), py::arg("threads"), py::arg("progress"));
    module.def(
        "batch",
        [](const std::string& sweep, const std::string& folder, bool retry, const py::object& threads,
           const py::object& progress) {
            return batchRuns(sweep, folder, retry, {threadsOf(threads), progress});
        },
        py::arg("sweep"), py::arg("folder"), py::kw_only(), py::arg("retry"), py::arg("threads"),
        py::arg("progress"));
    std::vector<std::string> searches;
    for (const LoadSearch& each : loadSearches()) searches.emplace_back(each.name);
    module.attr("searches") = py::cast(searches);
    module.attr("most_groups") = KeyBlockSettings{}.most_groups;
    module.attr("max_contact_points") = LimitSettings{}.max_contact_points;
}

}  // namespace talus::python
