#include "sweep/variables.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "scenario/fields.h"
#include "scenario/properties.h"
#include "sweep/case_table.h"
#include "toml/field_path.h"
#include "toml/file_text.h"
#include "toml/wording.h"

namespace talus::formats::sweep {

namespace {

using namespace toml;

constexpr std::size_t kMaxValues = 1'000'000;  // of one grid
constexpr const char* kNameColumn = "name";

constexpr Interval kNumber{};

std::optional<SweepValue> scalarOf(Report& report, const Node& node, const std::string& field) {
    ask(report, field, [] { return Asked{.kind = Asked::Kind::scalar}; });
    switch (node.kind()) {
        case Kind::integer:
            return node.integer();
        case Kind::real:
            if (const auto value = readNumber(report, node, field, kNumber)) return *value;
            return std::nullopt;
        case Kind::boolean:
            return node.boolean();
        case Kind::text:
            return node.text();
        default:
            reportFound(report, node, field, "a number, a string, true or false");
            return std::nullopt;
    }
}

class VariablesReader {
 public:
    VariablesReader(Report& report, TableReader& root, const std::string& path,
                    const scenario::KnownNames& known)
        : report_(report), root_(root), path_(path), known_(known) {}

    Variables read() {
        readTable();
        for (const FieldNode& entry : root_.tables("grid")) readGrid(entry);
        for (const FieldNode& entry : root_.tables("random")) readRandom(entry);
        return std::move(variables_);
    }

 private:
    // --- fields
    // -----------------------------------------------------------------------------------------------

    /// The scenario's fields behind one that may have `joint.*`. Faults are reported at `place`.
    std::vector<std::string> targetsOf(const std::string& written, const std::string& field, Place place) {
        const auto path = parseField(written);
        if (!path) {
            report_.add(
                place, field,
                "found " + toml::quoted(written) +
                    ", allowed: the path of a field of the scenario, like \"joint.default.friction_deg\" or "
                    "\"water[0].depth\"");
            return {};
        }
        const auto of_joint = scenario::jointField(*path);
        if (!of_joint || of_joint->joint != "*") {
            if (auto fault = scenario::unknownName(*path, known_)) {
                report_.add(place, field, std::move(*fault));
                return {};
            }
            return {written};
        }
        std::vector<std::string> targets;
        for (const std::string& joint : known_.joints)
            targets.push_back(joinField(joinField("joint", joint), of_joint->key));
        return targets;
    }

    /// A field may be set by one variable only.
    bool claim(const Variable& variable) {
        for (const std::string& target : variable.column.targets) {
            if (claimed_.insert(target).second) continue;
            const std::string message =
                "found " + toml::quoted(target) + " again, allowed: each field once in a sweep";
            if (variable.file.empty())
                report_.add(variable.place, variable.field + ".field", message);
            else
                variables_.errors.push_back(
                    {variable.field, message, variable.file, variable.place.line, variable.place.column});
            return false;
        }
        return true;
    }

    void add(Variable variable) {
        if (variable.column.targets.empty() || !claim(variable)) return;
        variable.column.unit = scenario::unitOf(variable.column.name);
        variables_.list.push_back(std::move(variable));
    }

    /// `field`: one, or a list of fields that get the same value.
    bool readFields(TableReader& table, Variable& variable) {
        const auto node = table.find("field");
        if (!node) return false;
        std::vector<std::string> names;
        if (node->kind() == Kind::array)
            names = table.texts("field", std::nullopt).value_or(std::vector<std::string>{});
        else if (auto name = table.text("field"))
            names.push_back(std::move(*name));
        if (node->kind() == Kind::array && node->size() == 0)
            table.error("field", "found an empty list, allowed: at least one field");
        for (const std::string& name : names)
            for (std::string& target : targetsOf(name, table.fieldOf("field"), table.placeOf("field")))
                variable.column.targets.push_back(std::move(target));
        if (!names.empty()) variable.column.name = names.front();
        variable.place = table.placeOf("field");
        return !variable.column.targets.empty();
    }

    // --- [[grid]]
    // ---------------------------------------------------------------------------------------------

    void readGrid(const FieldNode& entry) {
        TableReader table(report_, entry.node, entry.field,
                          {"field", "values", "from", "to", "count", "step"});
        table.require({"field"});
        Variable variable;
        variable.field = entry.field;
        variable.column.source = SweepSource::grid;
        const bool has_field = readFields(table, variable);
        if (table.has("values"))
            readValues(table, variable);
        else
            readSpan(table, variable);
        if (has_field && !variable.column.values.empty()) add(std::move(variable));
    }

    void readValues(TableReader& table, Variable& variable) {
        for (const char* key : {"from", "to", "count", "step"})
            if (table.has(key))
                table.error(key, "found together with `values`, allowed: either `values` or `from` and `to`");
        const auto array = table.array("values");
        if (!array) return;
        if (array->size() == 0) table.error("values", "found an empty list, allowed: at least one value");
        for (std::size_t i = 0; i < array->size(); ++i) {
            const auto value = scalarOf(report_, array->at(i), elementField(table.fieldOf("values"), i));
            if (!value) continue;
            variable.column.values.push_back(*value);
            variable.places.push_back(array->at(i).place());
        }
    }

    void readSpan(TableReader& table, Variable& variable) {
        if (!table.has("from") && !table.has("to")) {
            if (!table.isMeant("values"))
                table.error("values",
                            "missing; required: `values`, or `from` and `to` with `count` or `step`");
            return;
        }
        table.require({"from", "to"});
        const auto from = table.number("from", kNumber), to = table.number("to", kNumber);
        if (table.has("count") == table.has("step")) {
            table.error("count", "found " + std::string(table.has("count") ? "both" : "neither") +
                                     " `count` and `step`, allowed: one of them");
            return;
        }
        if (!from || !to) return;
        if (table.has("count"))
            fillCount(table, variable, *from, *to);
        else
            fillStep(table, variable, *from, *to);
        variable.places.assign(variable.column.values.size(), table.placeOf("from"));
    }

    void fillCount(TableReader& table, Variable& variable, double from, double to) {
        const auto count = table.integer("count", {2, kMaxValues});
        if (!count) return;
        for (std::int64_t i = 0; i < *count; ++i)
            variable.column.values.push_back(from + (to - from) * static_cast<double>(i) /
                                                        static_cast<double>(*count - 1));
    }

    /// Integers stay integers, since some fields take no others.
    void fillStep(TableReader& table, Variable& variable, double from, double to) {
        const auto step = table.number("step", kNumber);
        if (!step) return;
        const double steps = *step == 0 ? -1 : (to - from) / *step;
        if (!(steps >= 0) || steps > static_cast<double>(kMaxValues)) {
            table.error("step", "found a step of " + numberText(*step) + " from " + numberText(from) +
                                    " to " + numberText(to) + ", allowed: at most " +
                                    std::to_string(kMaxValues) + " values, with a step towards the last one");
            return;
        }
        bool integers = true;
        for (const char* key : {"from", "step"})
            integers = integers && table.find(key)->kind() == Kind::integer;
        for (double i = 0; i <= std::floor(steps + 1e-9); ++i) {
            const double value = from + i * *step;
            if (integers)
                variable.column.values.emplace_back(static_cast<std::int64_t>(value));
            else
                variable.column.values.emplace_back(value);
        }
    }

    // --- [table]
    // ----------------------------------------------------------------------------------------------

    void readTable() {
        auto table = root_.table("table", {"file", "columns", "rows"});
        if (!table) return;
        const bool has_rows = table->has("columns") || table->has("rows");
        if (table->has("file") == has_rows) {
            table->error("file", std::string("found ") +
                                     (has_rows ? "it together with `columns` and `rows`" : "no rows") +
                                     ", allowed: either `file`, or `columns` and `rows`");
        } else if (has_rows) {
            table->require({"columns", "rows"});
            readInlineTable(*table);
        } else if (const auto name = table->text("file")) {
            readTableFile(besideFile(path_, *name));
        }
    }

    void readInlineTable(TableReader& table) {
        const auto columns = table.texts("columns", std::nullopt);
        const auto rows = table.array("rows");
        if (!columns || !rows) return;
        if (rows->size() == 0 || columns->empty())
            table.error("rows", "found no rows or no columns, allowed: at least one of each");
        std::vector<Variable> list(columns->size());
        for (std::size_t i = 0; i < rows->size(); ++i) readRow(table, rows->at(i), i, list);
        for (std::size_t c = 0; c < list.size(); ++c) {
            list[c].field = elementField(table.fieldOf("columns"), c);
            list[c].place = table.find("columns")->at(c).place();
            addTableColumn(std::move(list[c]), (*columns)[c]);
        }
    }

    void readRow(TableReader& table, const Node& row, std::size_t index, std::vector<Variable>& list) {
        const std::string field = elementField(table.fieldOf("rows"), index);
        if (row.kind() != Kind::array || row.size() != list.size()) {
            report_.add(
                row.place(), field,
                "found " +
                    (row.kind() == Kind::array ? std::to_string(row.size()) + " values" : describe(row)) +
                    ", allowed: an array of " + std::to_string(list.size()) + " values, one per column");
            return;
        }
        for (std::size_t c = 0; c < list.size(); ++c) {
            const auto value = scalarOf(report_, row.at(c), elementField(field, c));
            list[c].column.values.push_back(value.value_or(SweepValue(false)));
            list[c].places.push_back(row.at(c).place());
        }
    }

    void readTableFile(const std::string& file) {
        const auto text = readFileText(file);
        auto cases = text ? parseCases(*text, file) : Result<CaseTable>(text.errors());
        if (!cases) {
            variables_.errors = cases.errors();
            return;
        }
        for (std::size_t c = 0; c < cases->header.size(); ++c) {
            const CaseTable::Cell& head = cases->header[c];
            Variable variable;
            variable.file = file;
            variable.place = {head.line, head.column};
            for (const auto& row : cases->rows) {
                variable.column.values.push_back(row[c].value);
                variable.places.push_back({row[c].line, row[c].column});
            }
            addTableColumn(std::move(variable), std::get<std::string>(head.value));
        }
    }

    void addTableColumn(Variable variable, const std::string& name) {
        if (name == kNameColumn) {
            for (const SweepValue& value : variable.column.values)
                variables_.case_names.push_back(toString(value));
            return;
        }
        variable.column.name = name;
        variable.column.source = SweepSource::table;
        if (variable.file.empty()) {
            variable.column.targets = targetsOf(name, variable.field, variable.place);
        } else if (const auto path = parseField(name)) {
            variable.field = name;
            if (auto fault = scenario::unknownName(*path, known_)) {
                variables_.errors.push_back(
                    {name, std::move(*fault), variable.file, variable.place.line, variable.place.column});
            } else {
                variable.column.targets = targetsOf(name, name, variable.place);
            }
        } else {
            variables_.errors.push_back(
                {"",
                 "found a column " + toml::quoted(name) + ", allowed: fields of the scenario, and \"name\"",
                 variable.file, variable.place.line, variable.place.column});
        }
        add(std::move(variable));
    }

    // --- [[random]]
    // -------------------------------------------------------------------------------------------

    void readRandom(const FieldNode& entry) {
        TableReader table(
            report_, entry.node, entry.field,
            {"field", "per", "distribution", "min", "max", "mean", "sd", "mode", "alpha", "beta"});
        table.require({"field", "distribution"});
        Variable variable;
        variable.field = entry.field;
        variable.column.source = SweepSource::random;
        const bool has_field = readFields(table, variable);
        const auto per = table.choice("per", {"run", "joint", "interface"}).value_or(0);
        variable.column.per = static_cast<SampledPer>(per);
        if (!readDistribution(table, variable.column.distribution) || !has_field) return;
        if (variable.column.per != SampledPer::run && !checkJointFields(table, variable)) return;
        if (variable.column.per == SampledPer::run) return add(std::move(variable));
        // Independent draws: one column per joint. Draws per interface are told apart by the interface, too.
        for (const std::string& target : variable.column.targets) {
            Variable one = variable;
            one.column.name = target;
            one.column.targets = {target};
            add(std::move(one));
        }
    }

    bool checkJointFields(TableReader& table, const Variable& variable) {
        const auto known = [](const std::string& target) {
            const auto of_joint = scenario::jointField(*parseField(target));
            const auto& keys = scenario::jointKeys();
            return of_joint && std::find(keys.begin(), keys.end(), of_joint->key) != keys.end();
        };
        const auto& targets = variable.column.targets;
        if (std::all_of(targets.begin(), targets.end(), known)) return true;
        table.error("per", "found draws per joint or interface of " + toml::quoted(variable.column.name) +
                               ", allowed there: \"joint.NAME.KEY\" or \"joint.*.KEY\" with KEY one of " +
                               listed(scenario::jointKeys()));
        return false;
    }

    bool readDistribution(TableReader& table, Distribution& d) {
        using K = Distribution::Kind;
        struct Rule {
            K kind;
            std::vector<std::string_view> keys;
        };
        static const std::vector<Rule> kRules = {{K::uniform, {"min", "max"}},
                                                 {K::normal, {"mean", "sd"}},
                                                 {K::truncated_normal, {"mean", "sd", "min", "max"}},
                                                 {K::lognormal, {"mean", "sd"}},
                                                 {K::triangular, {"min", "mode", "max"}},
                                                 {K::beta, {"alpha", "beta", "min", "max"}},
                                                 {K::integer, {"min", "max"}}};
        std::vector<std::string> names;
        for (const Rule& rule : kRules) names.emplace_back(toString(rule.kind));
        const auto choice = table.choice("distribution", names);
        if (!choice) return false;
        d.kind = kRules[*choice].kind;
        const auto& keys = kRules[*choice].keys;
        const std::size_t before = report_.count();
        for (const std::string_view key : keys) table.require({key});
        for (const char* key : {"min", "max", "mean", "sd", "mode", "alpha", "beta"})
            if (table.has(key) && std::find(keys.begin(), keys.end(), key) == keys.end())
                table.error(key, "found in a " + names[*choice] + " distribution, allowed there: " +
                                     listed(std::vector<std::string>(keys.begin(), keys.end())));
        d.min = table.number("min", kNumber).value_or(d.min);
        d.max = table.number("max", kNumber).value_or(d.max);
        d.mean = table.number("mean", d.kind == K::lognormal ? kPositive : kNumber).value_or(d.mean);
        d.sd = table.number("sd", kPositive).value_or(d.sd);
        d.mode = table.number("mode", kNumber).value_or(d.mode);
        d.alpha = table.number("alpha", kShape).value_or(d.alpha);
        d.beta = table.number("beta", kShape).value_or(d.beta);
        if (report_.count() == before) checkOrder(table, d);
        return report_.count() == before;
    }

    void checkOrder(TableReader& table, const Distribution& d) {
        for (const auto& [key, value] : {std::pair{"min", d.min}, {"max", d.max}})
            if (d.kind == Distribution::Kind::integer &&
                (value != std::floor(value) || std::abs(value) > kMostInteger))
                table.error(key, "found " + numberText(value) +
                                     " in an integer distribution, allowed: a whole number up to " +
                                     numberText(kMostInteger));
        if (table.has("max") && !(d.min < d.max))
            table.error("max",
                        "found " + numberText(d.max) + ", allowed: more than min, " + numberText(d.min));
        else if (d.kind == Distribution::Kind::triangular && !(d.min <= d.mode && d.mode <= d.max))
            table.error("mode", "found " + numberText(d.mode) + ", allowed: from min, " + numberText(d.min) +
                                    ", to max, " + numberText(d.max));
        else if (d.kind == Distribution::Kind::truncated_normal &&
                 !(d.max > d.mean - kFarTail * d.sd && d.min < d.mean + kFarTail * d.sd))
            table.error("mean",
                        "found a normal distribution without probability between min and max, allowed: a "
                        "range within " +
                            numberText(kFarTail) + " standard deviations of the mean");
    }

    static constexpr Interval kShape{0.01, 1e6, false, false};  ///< of a beta distribution
    static constexpr double kFarTail = 8;                       ///< [sd]
    static constexpr double kMostInteger = 1e9;  ///< far below 2^52, the number of different draws

    Report& report_;
    TableReader& root_;
    const std::string& path_;
    const scenario::KnownNames& known_;
    Variables variables_;
    std::set<std::string> claimed_;
};

}  // namespace

Variables readVariables(Report& report, TableReader& root, const std::string& path,
                        const scenario::KnownNames& known) {
    return VariablesReader(report, root, path, known).read();
}

std::string besideFile(const std::string& path, const std::string& name) {
    return (std::filesystem::path(path).parent_path() / name).string();
}

}  // namespace talus::formats::sweep
