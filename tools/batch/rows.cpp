#include "batch/rows.h"

#include <algorithm>

#include "batch/warnings.h"
#include "cli/json.h"

namespace talus::tools::batch {

namespace {

using formats::SampledPer;
using formats::Sweep;
using formats::SweepColumn;
using formats::SweepSource;
using Role = Column::Role;

std::string typeOf(const SweepColumn& column) {
    if (column.source == SweepSource::random)
        return column.distribution.kind == formats::Distribution::Kind::integer ? "integer" : "number";
    const auto all = [&](auto is) { return std::all_of(column.values.begin(), column.values.end(), is); };
    if (all([](const auto& v) { return std::holds_alternative<bool>(v); })) return "boolean";
    if (all([](const auto& v) { return std::holds_alternative<std::int64_t>(v); })) return "integer";
    if (all([](const auto& v) { return v.index() == 1 || v.index() == 2; })) return "number";
    return "string";
}

std::string sourceOf(const SweepColumn& column) {
    if (column.source == SweepSource::table) return "table";
    return column.source == SweepSource::grid ? "grid" : "random";
}

void addVaried(const SweepColumn& column, std::vector<Column>& columns) {
    std::string about = column.targets.size() > 1 ? "given to" : "";
    if (column.targets.size() > 1)
        for (const std::string& target : column.targets) about += " " + target;
    if (column.per != SampledPer::interface) {
        columns.push_back({column.name, typeOf(column), column.unit, about, Role::varied, sourceOf(column)});
        return;
    }
    for (const auto& [suffix, words] :
         {std::pair{".mean", "mean"}, {".min", "smallest"}, {".max", "largest"}})
        columns.push_back({column.name + suffix, "number", column.unit,
                           std::string(words) + " of the draws per interface", Role::varied, "interfaces"});
}

void addSearchColumns(const LoadSearch& search, bool with_range, bool with_groups,
                      std::vector<Column>& columns) {
    const std::string unit = search.load->unit;
    columns.push_back({search.answer_key, "number", unit, "middle of the bracket; empty unless found"});
    columns.push_back({search.keyInUnit("bracket_low"), "number", unit,
                       "largest load at which it stood; empty if there is none"});
    columns.push_back({search.keyInUnit("bracket_high"), "number", unit,
                       "load at which it failed; empty if there is none"});
    columns.push_back({search.keyInUnit(kCeiling), "number", unit,
                       "upper bound of limit analysis; empty if there is none or the model is too large"});
    columns.push_back({search.keyInUnit(kIntervalLow), "number", unit, "lowest answer found"});
    columns.push_back(
        {search.keyInUnit(kIntervalHigh), "number", unit, "highest answer found, or the upper bound"});
    if (with_range) {
        const char* empty = "; empty if all give the same answer";
        columns.push_back({search.keyInUnit(kRangeLow), "number", unit,
                           std::string("lowest answer of other loading paths") + empty});
        columns.push_back(
            {search.keyInUnit(kRangeHigh), "number", unit, std::string("largest of them") + empty});
        columns.push_back({"range_reason", "string", "", "why there is a range, or none"});
    }
    columns.push_back({search.theory_key, "number", unit, "limit equilibrium; empty if no formula applies"});
    columns.push_back({"failure_mode", "string", "", "none, sliding, toppling or mixed"});
    columns.push_back({"moving_count", "integer", "", "blocks that move at failure"});
    columns.push_back({"failing_volume_m3", "number", "m3", "of these"});
    columns.push_back({"failing_mass_kg", "number", "kg", "of these"});
    columns.push_back({"moving_mass_share", "number", "", "of the free blocks"});
    columns.push_back({"moving_blocks", "string", "", "their names; c1-3 r1-5 s1 for a box of them"});
    if (with_groups) {
        columns.push_back(
            {kGroupFactors, "string", "",
             "of the groups that fail one after the other, the first included; between them ;"});
        columns.push_back({kGroupBlocks, "string", "", "names of their blocks; between groups ;"});
    }
    columns.push_back({"left_out", "string", "",
                       "blocks that the answer does not include: fallen at the start, or removed before "
                       "because they are too small"});
    columns.push_back({"probes", "integer", "", "equilibria along the path"});
}

void addRunColumns(const formats::Sweep& sweep, std::vector<Column>& columns) {
    columns.push_back({"simulated_seconds", "number", "s", ""});
    columns.push_back({"time_step_s", "number", "s", ""});
    columns.push_back({"kinetic_energy_j", "number", "J", "at the end"});
    const auto scenario = formats::parseScenario(sweep.scenario_text, sweep.scenario_path);
    if (!scenario) return;
    for (const std::string& block : scenario->model.run.watch) {
        columns.push_back({block + ".displacement_m", "number", "m", "of its centroid since the start"});
        columns.push_back({block + ".rotation_deg", "number", "deg", "since the start"});
    }
}

std::vector<Column> columnsOf(const Sweep& sweep) {
    std::vector<Column> columns = {
        {"run", "integer", "", "number of the run, from 0: sample * cases + case", Role::key},
        {"case", "integer", "", "number of the case, from 0: row of the table and place in the grids",
         Role::key},
        {"sample", "integer", "", "number of the sample, from 0", Role::key}};
    if (!sweep.case_names.empty()) columns.push_back({"name", "string", "", "of the case", Role::key});
    for (const SweepColumn& column : sweep.columns) addVaried(column, columns);
    columns.push_back({"status", "string", "",
                       sweep.search ? "found, unstable_at_start, stable_to_stop, undecided or failed"
                                    : "finished or failed"});
    if (sweep.search)
        addSearchColumns(*sweep.search, sweep.tries_histories, sweep.groups > 1, columns);
    else
        addRunColumns(sweep, columns);
    columns.push_back({"steps", "integer", "", "along paths, or in time"});
    columns.push_back({"cpu_seconds", "number", "s", "processor time of the run"});
    columns.push_back({"state_hash", "string", "", "of the state at the end of the last step"});
    columns.push_back({kWarnings, "string", "",
                       std::string("of the input and of the run; between them") + kBetweenWarnings});
    columns.push_back({"reason", "string", "", "why a run failed or is undecided"});
    return columns;
}

const char* roleText(Role role) {
    return role == Role::key ? "key" : role == Role::varied ? "varied" : "result";
}

Role roleOf(const std::string& text) {
    return text == "key" ? Role::key : text == "varied" ? Role::varied : Role::result;
}

Json toJson(const Column& column) {
    return {{"name", column.name},   {"type", column.type},           {"unit", column.unit},
            {"about", column.about}, {"role", roleText(column.role)}, {"source", column.source}};
}

}  // namespace

std::string BatchInfo::answerName() const { return search() ? search()->answer_key : "kinetic_energy_j"; }

std::string BatchInfo::answerTitle() const {
    if (!search()) return "kinetic energy at the end (J)";
    const std::string symbol = unitSymbol();
    return search()->answer + (symbol.empty() ? "" : " (" + symbol + ")");
}

std::string BatchInfo::unitSymbol() const {
    const std::string unit = search() ? search()->load->unit : "";
    return unit == "deg" ? "\u00b0" : unit;
}

std::string BatchInfo::keyInUnit(std::string_view key) const {
    return search() ? search()->keyInUnit(key) : std::string(key);
}

bool BatchInfo::triesHistories() const { return find(keyInUnit(kRangeLow)).has_value(); }

std::optional<std::size_t> BatchInfo::find(std::string_view column) const {
    for (std::size_t i = 0; i < columns.size(); ++i)
        if (columns[i].name == column) return i;
    return std::nullopt;
}

BatchInfo describe(const Sweep& sweep) {
    BatchInfo info;
    info.identity = formats::identityOf(sweep);
    info.analysis = sweep.analysis();
    info.sweep = sweep.path;
    info.scenario = sweep.scenario_path;
    info.sweep_text = sweep.text;
    info.scenario_text = sweep.scenario_text;
    info.runs = sweep.runs();
    info.cases = sweep.cases;
    info.samples = sweep.samples;
    info.seed = sweep.seed;
    info.latin_hypercube = sweep.latin_hypercube;
    info.case_names = sweep.case_names;
    info.thresholds = sweep.report.thresholds;
    if (sweep.search && sweep.search->threshold && info.thresholds.empty())
        info.thresholds = {*sweep.search->threshold};
    info.confidence = sweep.report.confidence;
    info.columns = columnsOf(sweep);
    return info;
}

Json toJson(const BatchInfo& info) {
    Json columns = Json::array();
    for (const Column& column : info.columns) columns.push_back(toJson(column));
    return {{"format", 1},
            {"identity", info.identity},
            {"analysis", info.analysis},
            {"runs", info.runs},
            {"cases", info.cases},
            {"samples", info.samples},
            {"seed", info.seed},
            {"sampling", info.latin_hypercube ? "latin-hypercube" : "random"},
            {"thresholds", info.thresholds},
            {"confidence", info.confidence},
            {"case_names", info.case_names},
            {"columns", columns},
            {"sweep", info.sweep},
            {"scenario", info.scenario},
            {"sweep_text", info.sweep_text},
            {"scenario_text", info.scenario_text}};
}

BatchInfo infoFromJson(const Json& json) {
    BatchInfo info;
    json.at("identity").get_to(info.identity);
    json.at("analysis").get_to(info.analysis);
    json.at("runs").get_to(info.runs);
    json.at("cases").get_to(info.cases);
    json.at("samples").get_to(info.samples);
    json.at("seed").get_to(info.seed);
    info.latin_hypercube = json.at("sampling").get<std::string>() == "latin-hypercube";
    json.at("thresholds").get_to(info.thresholds);
    json.at("confidence").get_to(info.confidence);
    json.at("case_names").get_to(info.case_names);
    json.at("sweep").get_to(info.sweep);
    json.at("scenario").get_to(info.scenario);
    json.at("sweep_text").get_to(info.sweep_text);
    json.at("scenario_text").get_to(info.scenario_text);
    for (const Json& column : json.at("columns"))
        info.columns.push_back({column.at("name").get<std::string>(), column.at("type").get<std::string>(),
                                column.at("unit").get<std::string>(), column.at("about").get<std::string>(),
                                roleOf(column.at("role").get<std::string>()),
                                column.at("source").get<std::string>()});
    return info;
}

std::string csvHeader(const BatchInfo& info) {
    Row names;
    for (const Column& column : info.columns) names.push_back(column.name);
    return csvLine(names);
}

Json csvMetadata(const BatchInfo& info, const std::string& file) {
    Json columns = Json::array();
    for (const Column& column : info.columns) {
        Json entry{{"titles", column.name}, {"datatype", column.type}};
        if (!column.unit.empty()) entry["schema:unitText"] = column.unit;
        if (!column.about.empty()) entry["dc:description"] = column.about;
        columns.push_back(std::move(entry));
    }
    return {{"@context", "http://www.w3.org/ns/csvw"},
            {"url", file},
            {"dc:title", "talus batch, " + info.analysis + " of " + info.scenario},
            {"tableSchema", {{"columns", columns}}}};
}

bool isFailure(std::string_view status) { return status == "failed" || status == "undecided"; }

}  // namespace talus::tools::batch
