// The schemas against the readers: every key has a type, no key is one that the reader does not know, what is
// required is missed.

#include "talus/formats/schema.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "scenario/fields.h"
#include "scenario/read_document.h"
#include "schema/descriptions.h"
#include "schema/explore.h"
#include "schemas/schemas.h"
#include "talus/formats/scenario.h"

using namespace talus;
using namespace talus::formats;
using nlohmann::json;

namespace {

const json& theSchema() {
    static const json schema = json::parse(scenarioSchema());
    return schema;
}

/// Calls each(path, schema) of every property, tables in lists and under names too.
template <class Each>
void eachProperty(const json& schema, const std::string& path, const Each& each) {
    if (schema.contains("anyOf"))
        for (const json& one : schema["anyOf"]) eachProperty(one, path, each);
    if (schema.contains("items")) eachProperty(schema["items"], path + "[]", each);
    if (schema.contains("additionalProperties") && schema["additionalProperties"].is_object())
        eachProperty(schema["additionalProperties"], path + ".NAME", each);
    if (!schema.contains("properties")) return;
    for (const auto& [key, value] : schema["properties"].items()) {
        each(path + "." + key, value);
        eachProperty(value, path + "." + key, each);
    }
}

bool mentions(const Result<Scenario>& result, const std::string& field, const std::string& words) {
    for (const Error& error : result.errors())
        if (error.field == field && error.message.find(words) != std::string::npos) return true;
    return false;
}

const json& at(const std::string& section, const std::string& key) {
    const json& table = theSchema()["properties"][section];
    if (table.contains("items")) return table["items"]["properties"][key];
    if (table["additionalProperties"].is_object()) return table["additionalProperties"]["properties"][key];
    return table["properties"][key];
}

}  // namespace

TEST_CASE("schema: every key of every table has its type, and elements have theirs") {
    for (const json& schema : {theSchema(), json::parse(sweepSchema())}) {
        std::size_t count = 0;
        eachProperty(schema, "", [&](const std::string& path, const json& value) {
            CAPTURE(path);
            CHECK_FALSE(value.empty());
            if (value.contains("items")) CHECK_FALSE(value["items"].empty());
            ++count;
        });
        CHECK(count > 20);
    }
}

TEST_CASE(
    "schema: has the sections and keys that the reader allows, and the reader knows all of the schema's") {
    // What the reader says of an unknown key is its own list.
    const auto root = parseScenario("zzzzzz = 1\n", "test.toml");
    for (const auto& property : theSchema()["properties"].items()) {
        const std::string key = property.key();
        CAPTURE(key);
        CHECK(mentions(root, "zzzzzz", key));
    }
    for (const auto& entry : theSchema()["properties"].items()) {
        const std::string section = entry.key();
        const json& table = entry.value();
        if (!table.contains("items") && !table.contains("properties")) continue;
        const bool list = table.contains("items");
        // Sections of the rock mass are read where there is one.
        const std::string text =
            "rock_mass = {}\n" + (list ? "[[" + section + "]]" : "[" + section + "]") + "\nzzzzzz = 1\n";
        const auto read =
            parseScenario(section == "rock_mass" ? "[rock_mass]\nzzzzzz = 1\n" : text, "test.toml");
        const std::string field = section + (list ? "[0]" : "") + ".zzzzzz";
        const json& properties = list ? table["items"]["properties"] : table["properties"];
        for (const auto& property : properties.items()) {
            const std::string key = property.key();
            CAPTURE(section);
            CAPTURE(key);
            CHECK(mentions(read, field, key));
        }
    }
}

TEST_CASE("schema: what it says of some keys is what the reader says") {
    CHECK(at("joint", "friction_deg")["minimum"] == 0);
    CHECK(at("joint", "friction_deg")["exclusiveMaximum"] == 90);
    CHECK(at("joint", "friction_deg")["description"] == "angle of friction, peak [deg]");
    CHECK(at("joint", "normal_stiffness")["minimum"] == 1000);
    CHECK(at("joint", "normal_stiffness")["maximum"] == 1e15);
    CHECK(at("joint", "law")["enum"] == json{"coulomb", "barton-bandis", "envelope", "power"});
    CHECK(at("stack", "columns")["type"] == "integer");
    CHECK(at("stack", "bond")["enum"] == json{"stack", "running"});
    CHECK(at("stack", "heights")["items"]["type"] == "integer");
    CHECK_FALSE(at("stack", "heights")["items"].contains("maximum"));   // it depends on `rows`
    CHECK(at("stack", "bed_friction_deg")["items"].contains("anyOf"));  // a number a level, or a list of them
    CHECK(at("block", "box")["properties"]["min"]["minItems"] == 3);
    CHECK(at("water", "levels")["items"]["minItems"] == 2);
    CHECK(at("water", "face")["enum"].size() == 6);
    CHECK(at("load", "pressure")["minimum"] == 0);
    CHECK(at("rock_mass", "region")["properties"]["stl"]["type"] == "string");
    const auto required = [](const std::string& section) {
        const json& table = theSchema()["properties"][section];
        const json& list = table.contains("items") ? table["items"] : table["additionalProperties"];
        return list.value("required", json::array()).get<std::set<std::string>>();
    };
    CHECK(required("stack") == std::set<std::string>{"columns", "rows", "slices", "block"});
    CHECK(required("material") == std::set<std::string>{"density"});
    CHECK(required("joint") ==
          std::set<std::string>{"normal_stiffness", "shear_stiffness"});  // friction: of Coulomb's
    CHECK(required("joint_set") == std::set<std::string>{"dip_deg", "dip_direction_deg", "spacing"});
}

TEST_CASE("schema: says of every key what it means, and nothing of keys that there are not") {
    const auto check = [](const std::string& text, std::span<const schema::Description> lines) {
        std::set<std::string> fields;
        eachProperty(json::parse(text), "", [&](const std::string& path, const json& value) {
            CAPTURE(path);
            // More than a unit.
            CHECK(value.value("description", "[").front() != '[');
            fields.insert(path.substr(1));
        });
        std::set<std::string_view> said;
        for (const schema::Description& line : lines) {
            CAPTURE(std::string(line.field));
            CHECK(said.insert(line.field).second);
            const bool anywhere = line.field.starts_with(schema::kAnywhere);
            const std::string end(anywhere ? line.field.substr(schema::kAnywhere.size() - 1) : "");
            CHECK(std::any_of(fields.begin(), fields.end(), [&](const std::string& field) {
                // Values under any name have no key of their own.
                return anywhere ? field.ends_with(end) : field == line.field || field + ".NAME" == line.field;
            }));
        }
    };
    check(scenarioSchema(), schema::scenarioDescriptions());
    check(sweepSchema(), schema::sweepDescriptions());
}

TEST_CASE("units: a key of several tables has the unit of its own") {
    CHECK(scenario::unitOf("stack[0].block") == "m");
    CHECK(scenario::unitOf("load[0].block") == "");
    CHECK(scenario::unitOf("joint.default.shear_stiffness") == "Pa/m");
    CHECK(scenario::unitOf("bolt[2].shear_stiffness") == "N/m");
    CHECK(scenario::unitOf("damping.contact") == "s");
    CHECK(scenario::unitOf("contact") == "");
    CHECK(scenario::unitOf("gravity.magnitude") == "m/s^2");
}

TEST_CASE("schema: the program has the one that its readers have") {
    CHECK(scenarioSchema() == tools::kScenarioSchema);
    CHECK(sweepSchema() == tools::kSweepSchema);
}

TEST_CASE("schema: of sweeps") {
    const json schema = json::parse(sweepSchema());
    CHECK(schema["required"] == json{"scenario", "analysis"});
    CHECK(schema["properties"]["analysis"]["enum"].size() == 4);
    const json& grid = schema["properties"]["grid"]["items"]["properties"];
    CHECK(grid["values"]["items"]["type"] == json{"boolean", "number", "string"});
    CHECK(grid["count"]["type"] == "integer");
    const json& random = schema["properties"]["random"]["items"]["properties"];
    CHECK(random["distribution"]["enum"].size() == 7);
    CHECK(random["sd"]["exclusiveMinimum"] == 0);
}

TEST_CASE(
    "explore: finds keys that are read only together with others, choices, and what depends on values") {
    // A reader of its own: `b` is read with `a` of kind "two" alone, up to what `a` says.
    const auto read = [](const std::string& text, toml::Questions& questions) {
        const auto document = toml::Document::parse(text, "");
        REQUIRE(document.ok());
        toml::Report report("");
        report.listen(&questions);
        toml::TableReader root(report, document->root(), "", {"list"});
        for (const toml::FieldNode& entry : root.tables("list")) {
            toml::TableReader table(report, entry.node, entry.field, {"kind", "a", "b"});
            table.require({"kind"});
            const auto kind = table.choice("kind", {"one", "two"});
            const auto a = table.integer("a", {1, 5});
            if (kind == std::size_t{1} && a) table.integer("b", {0, *a});
        }
    };
    const toml::Questions questions = schema::explore(read);
    REQUIRE(questions.asked().contains("list[].b"));
    CHECK(questions.asked().at("list[].kind").front().choices.size() == 2);
    CHECK(questions.tables().at("list[]").required == std::set<std::string>{"kind"});
}
