#include "talus/formats/schema.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "scenario/fields.h"
#include "scenario/read_document.h"
#include "schema/descriptions.h"
#include "schema/explore.h"
#include "sweep/questions.h"

namespace talus::formats {

namespace {

using toml::Asked;
using toml::Questions;
using Kind = Asked::Kind;
using Json = nlohmann::ordered_json;

constexpr std::int64_t kFewBlocks = 1000;
constexpr const char* kAnyName = "default";  // what the explorer calls named tables

constexpr const char* kSmallScenario =
    "[material.default]\ndensity = 2700\n[joint.default]\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\n"
    "friction_deg = 30\n"
    "[[stack]]\ncolumns = 1\nrows = 1\nslices = 1\nblock = [1, 1, 1]\n";

/// The range of all that was asked of a field. An end that is not always the same depends on other values: it
/// is left out.
Interval commonRange(const std::vector<Asked>& asked) {
    Interval common = asked.front().range;
    for (const Asked& one : asked) {
        if (one.range.min != common.min || one.range.open_min != common.open_min) common.min = -kInfinity;
        if (one.range.max != common.max || one.range.open_max != common.open_max) common.max = kInfinity;
    }
    return common;
}

Json numberSchema(const std::vector<Asked>& asked) {
    const Interval range = commonRange(asked);
    Json json{{"type", "number"}};
    if (std::isfinite(range.min)) json[range.open_min ? "exclusiveMinimum" : "minimum"] = range.min;
    if (std::isfinite(range.max)) json[range.open_max ? "exclusiveMaximum" : "maximum"] = range.max;
    return json;
}

Json integerSchema(const std::vector<Asked>& asked) {
    const auto same = [&](auto end) {
        return std::all_of(asked.begin(), asked.end(),
                           [&](const Asked& one) { return one.bounds.*end == asked.front().bounds.*end; });
    };
    Json json{{"type", "integer"}};
    if (same(&toml::Bounds::min)) json["minimum"] = asked.front().bounds.min;
    if (same(&toml::Bounds::max)) json["maximum"] = asked.front().bounds.max;
    return json;
}

Json choiceSchema(const std::vector<Asked>& asked) {
    Json names = Json::array();
    for (const Asked& one : asked)
        for (const std::string& name : one.choices)
            if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    return {{"enum", names}};
}

class SchemaWriter {
 public:
    /// \param of_scenario  whether its fields have the units of a scenario's
    SchemaWriter(const Questions& questions, std::span<const schema::Description> lines, bool of_scenario)
        : questions_(questions), lines_(lines), of_scenario_(of_scenario) {}

    Json table(const std::string& field) const {
        Json properties = Json::object(), required = Json::array();
        const Questions::Table& table = questions_.tables().at(field);
        for (const std::string& key : table.keys) {
            properties[key] = value(field.empty() ? key : field + "." + key);
            if (table.required && table.required->contains(key)) required.push_back(key);
        }
        Json json{{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
        if (!required.empty()) json["required"] = required;
        return json;
    }

 private:
    Json value(const std::string& field) const {
        const auto asked = questions_.asked().find(field);
        if (asked == questions_.asked().end()) {
            // Asked for by its elements alone.
            if (questions_.asked().contains(field + "[]"))
                return {{"type", "array"}, {"items", value(field + "[]")}};
            return Json::object();
        }
        std::map<Kind, std::vector<Asked>> kinds;
        for (const Asked& one : asked->second) kinds[one.kind].push_back(one);
        if (kinds.contains(Kind::number)) kinds.erase(Kind::integer);
        if (kinds.contains(Kind::scalar)) kinds.erase(Kind::number);
        Json schemas = Json::array();
        for (const auto& [kind, questions] : kinds) schemas.push_back(of(kind, questions, field));
        Json json = schemas.size() == 1 ? schemas.front() : Json{{"anyOf", schemas}};
        describe(field, json);
        return json;
    }

    Json of(Kind kind, const std::vector<Asked>& asked, const std::string& field) const {
        switch (kind) {
            case Kind::number:
                return numberSchema(asked);
            case Kind::integer:
                return integerSchema(asked);
            case Kind::boolean:
                return {{"type", "boolean"}};
            case Kind::text:
                return {{"type", "string"}};
            case Kind::choice:
                return choiceSchema(asked);
            case Kind::scalar:
                return {{"type", {"boolean", "number", "string"}}};
            case Kind::array:
                return array(asked, field);
            case Kind::table:
                return table(field);
            case Kind::tables:
                return {{"type", "array"}, {"items", table(field + "[]")}};
            case Kind::named_tables:
                return {{"type", "object"}, {"additionalProperties", table(field + "." + kAnyName)}};
            case Kind::named_values:
                break;
        }
        return {{"type", "object"}, {"additionalProperties", value(field + "." + kAnyName)}};
    }

    Json array(const std::vector<Asked>& asked, const std::string& field) const {
        Json json{{"type", "array"}, {"items", value(field + "[]")}};
        const auto length = asked.front().length;
        const bool same =
            std::all_of(asked.begin(), asked.end(), [&](const Asked& one) { return one.length == length; });
        if (same && length) json["minItems"] = json["maxItems"] = *length;
        return json;
    }

    /// What a property is, and its unit.
    void describe(const std::string& field, Json& json) const {
        const std::string unit = of_scenario_ ? scenario::unitOf(field) : "";
        const std::string text = textOf(field) + (unit.empty() ? "" : " [" + unit + "]");
        if (!text.empty()) json["description"] = text;
    }

    std::string textOf(std::string field) const {
        const auto property = jointProperty(field.substr(field.rfind('.') + 1));
        if (property && (field.starts_with("joint.") || field.starts_with("interface")))
            return std::string(kJointProperties[*property].what);
        const std::string any = std::string(".") + kAnyName;
        if (const auto at = field.find(any); at != std::string::npos) field.replace(at, any.size(), ".NAME");
        return std::string(schema::descriptionOf(lines_, field));
    }

    const Questions& questions_;
    std::span<const schema::Description> lines_;
    bool of_scenario_;
};

std::string schemaText(const SchemaWriter& writer, const char* title) {
    Json json{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", title}};
    json.update(writer.table(""));
    return json.dump(2) + "\n";
}

}  // namespace

std::string scenarioSchema() {
    const Questions questions = schema::explore([](const std::string& text, Questions& heard) {
        if (const auto document = toml::Document::parse(text, ""))
            scenario::readDocument(*document, text, "", kFewBlocks, nullptr, &heard);
    });
    return schemaText({questions, schema::scenarioDescriptions(), true}, "Talus scenario");
}

std::string sweepSchema() {
    const auto small = parseScenario(kSmallScenario, "");
    const Questions questions = schema::explore([&](const std::string& text, Questions& heard) {
        if (const auto document = toml::Document::parse(text, ""))
            sweep::questionsOf(*document, *small, heard);
    });
    return schemaText({questions, schema::sweepDescriptions(), false}, "Talus sweep");
}

}  // namespace talus::formats
