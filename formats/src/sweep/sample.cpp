// From the number of a run to its sample, and from there to a scenario.

#include <algorithm>
#include <map>

#include "scenario/read_document.h"
#include "sweep/random.h"
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
double draw(const Sweep& sweep, const SweepColumn& column, std::uint64_t sample, const std::string& name) {
    const std::uint64_t stream = sweep::streamOf(name);
    const double share = sweep.latin_hypercube
                             ? sweep::latinHypercube(sample, sweep.samples, sweep.seed, stream)
                             : sweep::uniform(sweep.seed, stream, sample);
    return quantile(column.distribution, share);
}

std::optional<Error> put(Document& document, const std::string& target, const SweepValue& value,
                         bool may_append = false) {
    const auto path = toml::parseField(target);
    if (!path) return Error{target, "is not the path of a field"};
    if (const auto fault = document.set(*path, value, may_append)) return Error{target, *fault};
    return std::nullopt;
}

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

using NamePair = std::pair<std::string, std::string>;

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

/// Gives every interface of the columns' joints its own draws, as entries of the document.
class InterfaceDraws {
 public:
    InterfaceDraws(const Sweep& sweep, const SweepRun& run, Document& document)
        : sweep_(sweep), run_(run), document_(document), entries_(interfaceEntries(document)) {
        for (std::size_t c = 0; c < sweep.columns.size(); ++c)
            if (sweep.columns[c].per == SampledPer::interface) drawn_.push_back({c, 0, 0, 0, 0});
    }

    /// Errors: the pairs' own, an interface that cannot be edited.
    std::vector<Error> apply(const Model& model) {
        const auto pairs = touchingPairs(model);
        if (!pairs) return pairs.errors();
        for (const TouchingPair& pair : *pairs)
            for (DrawnRange& drawn : drawn_)
                if (auto error = applyTo(model, pair, drawn)) return {*error};
        for (DrawnRange& drawn : drawn_)
            if (drawn.interfaces > 0) drawn.mean /= static_cast<double>(drawn.interfaces);
        return {};
    }

    std::vector<DrawnRange> takeDrawn() { return std::move(drawn_); }

 private:
    std::optional<Error> applyTo(const Model& model, const TouchingPair& pair, DrawnRange& drawn) {
        const SweepColumn& column = sweep_.columns[drawn.column];
        const auto of_joint = *toml::jointField(*toml::parseField(column.targets.front()));
        if (model.joints[static_cast<std::size_t>(pair.joint)].name != of_joint.joint) return std::nullopt;
        const auto nameOf = [&](std::int32_t block) {
            return model.blocks[static_cast<std::size_t>(block)].name;
        };
        const NamePair names{nameOf(pair.block_a), nameOf(pair.block_b)};
        // By the blocks' names, so that an interface draws the same in a larger slope.
        const NamePair sorted = std::minmax(names.first, names.second);
        const double value =
            draw(sweep_, column, run_.sample, column.name + "|" + sorted.first + "|" + sorted.second);
        count(drawn, value);
        const std::string entry = entryOf(names, sorted, of_joint.joint);
        if (entry.empty()) return Error{"interface", "cannot be added to the scenario"};
        return put(document_, entry + "." + of_joint.key, value);
    }

    /// "interface[3]", made if it is not there; "" if that cannot be.
    std::string entryOf(const NamePair& names, const NamePair& sorted, const std::string& joint) {
        const auto [place, is_new] = entries_.try_emplace(sorted, entries_.size());
        const std::string entry = "interface[" + std::to_string(place->second) + "]";
        if (is_new && (put(document_, entry + ".between[0]", names.first, true) ||
                       put(document_, entry + ".between[1]", names.second, true) ||
                       put(document_, entry + ".joint", joint)))
            return "";
        return entry;
    }

    static void count(DrawnRange& drawn, double value) {
        drawn.min = drawn.interfaces ? std::min(drawn.min, value) : value;
        drawn.max = drawn.interfaces ? std::max(drawn.max, value) : value;
        drawn.mean += value;
        ++drawn.interfaces;
    }

    const Sweep& sweep_;
    const SweepRun& run_;
    Document& document_;
    std::map<NamePair, std::size_t> entries_;
    std::vector<DrawnRange> drawn_;
};

/// The run's document, complete, and its draws per interface.
struct Sampled {
    Document document;
    std::vector<DrawnRange> drawn;
};

Result<Sampled> sampled(const Sweep& sweep, const SweepRun& run) {
    auto document = editedDocument(sweep, run);
    if (!document) return document.errors();
    if (!drawsPerInterface(sweep)) return Sampled{*document, {}};
    const auto plain = scenario::readDocument(*document, "", sweep.scenario_path);
    if (!plain) return plain.errors();
    InterfaceDraws draws(sweep, run, *document);
    const auto errors = draws.apply(plain->model);
    if (!errors.empty()) return placed(*plain, errors);
    return Sampled{*document, draws.takeDrawn()};
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
            run.values[c] = draw(sweep, column, run.sample, column.name);
    }
    return run;
}

Result<SampledScenario> scenarioOf(const Sweep& sweep, const SweepRun& run) {
    auto whole = sampled(sweep, run);
    if (!whole) return whole.errors();
    auto scenario = scenario::readDocument(whole->document, "", sweep.scenario_path);
    if (!scenario) return scenario.errors();
    return SampledScenario{std::move(*scenario), std::move(whole->drawn)};
}

Result<std::string> scenarioTextOf(const Sweep& sweep, const SweepRun& run) {
    auto whole = sampled(sweep, run);
    if (!whole) return whole.errors();
    return toml::writeDocument(whole->document);
}

}  // namespace talus::formats
