// From the number of a run to its sample, and from there to a scenario.

#include <algorithm>
#include <map>

#include "scenario/fields.h"
#include "scenario/read_document.h"
#include "sweep/random.h"
#include "sweep/runs.h"
#include "talus/formats/overrides.h"
#include "talus/formats/sweep.h"
#include "talus/simulation.h"
#include "toml/document.h"
#include "toml/field_path.h"
#include "toml/wording.h"
#include "toml/write_document.h"

namespace talus::formats {

namespace {

using toml::Document;

/// Drawn for this purpose and no other: the name decides the stream of random numbers.
double share(const Sweep& sweep, std::uint64_t sample, const std::string& name) {
    const std::uint64_t stream = sweep::streamOf(name);
    return sweep.latin_hypercube ? sweep::latinHypercube(sample, sweep.samples, sweep.seed, stream)
                                 : sweep::uniform(sweep.seed, stream, sample);
}

/// Of a correlated variable (sweep/correlation.h).
double correlatedShare(const Sweep& sweep, const SweepColumn& column, std::uint64_t sample) {
    double score = 0;
    for (const ScoreShare& part : column.scores)
        score += part.weight * normalQuantile(share(sweep, sample, sweep.columns[part.column].name));
    return std::clamp(normalProbability(score), 0x1p-53, 1 - 0x1p-53);
}

double drawRun(const Sweep& sweep, const SweepColumn& column, std::uint64_t sample) {
    return quantile(column.distribution, column.scores.empty() ? share(sweep, sample, column.name)
                                                               : correlatedShare(sweep, column, sample));
}

std::optional<Error> put(Document& document, const std::string& target, const SweepValue& value,
                         bool may_append = false) {
    const auto path = toml::parseField(target);
    if (!path) return Error{target, "is not the path of a field"};
    if (const auto fault = document.set(*path, value, may_append)) return Error{target, *fault};
    return std::nullopt;
}

/// The scenario's text with the run's values in it, but for its draws per interface.
Result<Document> editedDocument(const Sweep& sweep, const SweepRun& run) {
    auto document = Document::parse(sweep.scenario_text, sweep.scenario_path);
    if (!document) return document.errors();
    for (std::size_t c = 0; c < sweep.columns.size(); ++c) {
        if (sweep.columns[c].per == SampledPer::interface) continue;
        for (const std::string& target : sweep.columns[c].targets)
            if (auto error = put(*document, target, run.values[c])) return *error;
    }
    return document;
}

bool drawsPerInterface(const Sweep& sweep) {
    return std::any_of(sweep.columns.begin(), sweep.columns.end(),
                       [](const SweepColumn& column) { return column.per == SampledPer::interface; });
}

std::optional<double> numberIn(const SweepValue& value) {
    if (const auto* real = std::get_if<double>(&value)) return *real;
    if (const auto* integer = std::get_if<std::int64_t>(&value)) return static_cast<double>(*integer);
    return std::nullopt;
}

/// The sweep's scenario with the run's values put into its model. Nothing when a value needs the reader: it
/// defines blocks, or is wrong and needs an error.
std::optional<Scenario> overridden(const Sweep& sweep, const SweepRun& run) {
    if (!sweep.base || !sweep.only_overrides) return std::nullopt;
    Scenario scenario = *sweep.base;
    for (std::size_t c = 0; c < sweep.columns.size(); ++c) {
        if (sweep.columns[c].per == SampledPer::interface) continue;
        const auto value = numberIn(run.values[c]);
        for (const std::string& target : sweep.columns[c].targets)
            if (!value || !applyOverride(scenario, target, *value)) return std::nullopt;
    }
    return scenario;
}

/// The run's scenario but for its draws per interface.
Result<Scenario> plainScenario(const Sweep& sweep, const SweepRun& run) {
    if (auto scenario = overridden(sweep, run)) return *std::move(scenario);
    const auto document = editedDocument(sweep, run);
    if (!document) return document.errors();
    return scenario::readDocument(*document, "", sweep.scenario_path);
}

using NamePair = std::pair<std::string, std::string>;

/// What was drawn for the interfaces, in the order of their blocks.
struct InterfaceDraws {
    std::vector<PairOverride> values;
    std::vector<DrawnRange> ranges;  ///< one per column of draws per interface
};

void count(DrawnRange& drawn, double value) {
    drawn.min = drawn.interfaces ? std::min(drawn.min, value) : value;
    drawn.max = drawn.interfaces ? std::max(drawn.max, value) : value;
    drawn.mean += value;
    ++drawn.interfaces;
}

NamePair namesOf(const Model& model, std::int32_t block_a, std::int32_t block_b) {
    return {model.blocks[static_cast<std::size_t>(block_a)].name,
            model.blocks[static_cast<std::size_t>(block_b)].name};
}

/// Every interface of a column's joint gets its own draw.
InterfaceDraws drawInterfaces(const Sweep& sweep, const SweepRun& run, const Model& model,
                              const std::vector<TouchingPair>& pairs) {
    InterfaceDraws draws;
    std::vector<scenario::JointField> fields;
    for (std::size_t c = 0; c < sweep.columns.size(); ++c) {
        if (sweep.columns[c].per != SampledPer::interface) continue;
        draws.ranges.push_back({c, 0, 0, 0, 0});
        fields.push_back(*scenario::jointField(*toml::parseField(sweep.columns[c].targets.front())));
    }
    for (const TouchingPair& pair : pairs)
        for (std::size_t k = 0; k < fields.size(); ++k) {
            if (model.joints[static_cast<std::size_t>(pair.joint)].name != fields[k].joint) continue;
            const SweepColumn& column = sweep.columns[draws.ranges[k].column];
            // By the blocks' names, so that an interface draws the same in a larger slope.
            const NamePair names = namesOf(model, pair.block_a, pair.block_b);
            const auto [first, second] = std::minmax(names.first, names.second);
            const double value = quantile(column.distribution,
                                          share(sweep, run.sample, column.name + "|" + first + "|" + second));
            count(draws.ranges[k], value);
            draws.values.push_back(
                {pair.block_a, pair.block_b, pair.joint, *jointProperty(fields[k].key), value});
        }
    for (DrawnRange& drawn : draws.ranges)
        if (drawn.interfaces > 0) drawn.mean /= static_cast<double>(drawn.interfaces);
    return draws;
}

/// The draws of a run whose scenario is `plain`. Errors: its blocks cannot be built.
Result<InterfaceDraws> drawnFor(const Sweep& sweep, const SweepRun& run, const Scenario& plain) {
    if (!drawsPerInterface(sweep)) return InterfaceDraws{};
    if (sweep.base_pairs) return drawInterfaces(sweep, run, plain.model, *sweep.base_pairs);
    const auto pairs = touchingPairs(plain.model);
    if (!pairs) return placed(plain, pairs.errors());
    return drawInterfaces(sweep, run, plain.model, *pairs);
}

/// The [[interface]] entries of a document, by their blocks.
std::map<NamePair, std::size_t> interfaceEntries(const Document& document) {
    std::map<NamePair, std::size_t> entries;
    const auto array = document.root().find("interface");
    if (!array || array->kind() != toml::Kind::array) return entries;
    for (std::size_t i = 0; i < array->size(); ++i) {
        const auto between = array->at(i).find("between");
        entries[std::minmax(between->at(0).text(), between->at(1).text())] = i;
    }
    return entries;
}

/// The draws as entries of the document.
std::optional<Error> write(const InterfaceDraws& draws, const Model& model, Document& document) {
    auto entries = interfaceEntries(document);
    for (const PairOverride& drawn : draws.values) {
        const NamePair names = namesOf(model, drawn.block_a, drawn.block_b);
        const auto [place, is_new] =
            entries.try_emplace(std::minmax(names.first, names.second), entries.size());
        const std::string entry = toml::elementField("interface", place->second);
        const std::string& joint = model.joints[static_cast<std::size_t>(drawn.joint)].name;
        if (is_new && (put(document, entry + ".between[0]", names.first, true) ||
                       put(document, entry + ".between[1]", names.second, true) ||
                       put(document, entry + ".joint", joint)))
            return Error{"interface", "cannot be added to the scenario"};
        const std::string key(kJointProperties[drawn.property].key);
        if (auto error = put(document, entry + "." + key, drawn.value)) return error;
    }
    return std::nullopt;
}

/// The run as a document, complete.
Result<Document> writtenRun(const Sweep& sweep, const SweepRun& run, const InterfaceDraws& draws,
                            const Model& plain) {
    auto document = editedDocument(sweep, run);
    if (!document) return document;
    if (auto error = write(draws, plain, *document)) return *error;
    return document;
}

}  // namespace

SweepRun runOf(const Sweep& sweep, std::uint64_t index) {
    SweepRun run{index, index % sweep.cases, index / sweep.cases, {}};
    std::uint64_t rest = run.case_index;
    run.values.resize(sweep.columns.size(), false);
    for (std::size_t c = sweep.columns.size(); c-- > 0;) {
        const SweepColumn& column = sweep.columns[c];
        if (column.source != SweepSource::grid) continue;
        run.values[c] = column.values[rest % column.values.size()];
        rest /= column.values.size();
    }
    for (std::size_t c = 0; c < sweep.columns.size(); ++c) {
        const SweepColumn& column = sweep.columns[c];
        if (column.source == SweepSource::table) run.values[c] = column.values[rest];
        if (column.source == SweepSource::random && column.per != SampledPer::interface)
            run.values[c] = drawRun(sweep, column, run.sample);
    }
    return run;
}

void prepareRuns(Sweep& sweep, std::shared_ptr<const Scenario> base) {
    sweep.only_overrides = true;
    // The joint between two blocks is the one with less friction: a number of its strength may make it
    // another.
    const auto decides = [](std::string_view key) {
        const auto p = jointProperty(key);
        return p && (kJointProperties[*p].value == &Joint::friction ||
                     kJointProperties[*p].value == &Joint::residual_friction ||
                     !kJointProperties[*p].laws.has(StrengthLaw::coulomb));
    };
    bool same_joints = true;
    for (const SweepColumn& column : sweep.columns) {
        if (column.per == SampledPer::interface) continue;
        for (const std::string& target : column.targets) {
            sweep.only_overrides = sweep.only_overrides && canOverride(*base, target);
            const auto of_joint = scenario::jointField(*toml::parseField(target));
            same_joints = same_joints && !(of_joint && decides(of_joint->key));
        }
    }
    if (sweep.only_overrides && same_joints && drawsPerInterface(sweep))
        if (auto pairs = touchingPairs(base->model))
            sweep.base_pairs = std::make_shared<const std::vector<TouchingPair>>(*std::move(pairs));
    sweep.base = std::move(base);
}

Result<SampledScenario> scenarioOf(const Sweep& sweep, const SweepRun& run) {
    auto plain = plainScenario(sweep, run);
    if (!plain) return plain.errors();
    auto draws = drawnFor(sweep, run, *plain);
    if (!draws) return draws.errors();
    if (!draws->values.empty() && !overridePairs(*plain, draws->values)) {
        const auto document = writtenRun(sweep, run, *draws, plain->model);  // the reader says what is wrong
        if (!document) return document.errors();
        plain = scenario::readDocument(*document, "", sweep.scenario_path);
        if (!plain) return plain.errors();
    }
    return SampledScenario{*std::move(plain), std::move(draws->ranges)};
}

Result<std::string> scenarioTextOf(const Sweep& sweep, const SweepRun& run) {
    const auto plain = plainScenario(sweep, run);
    if (!plain) return plain.errors();
    const auto draws = drawnFor(sweep, run, *plain);
    if (!draws) return draws.errors();
    const auto document = writtenRun(sweep, run, *draws, plain->model);
    if (!document) return document.errors();
    return toml::writeDocument(*document);
}

}  // namespace talus::formats
