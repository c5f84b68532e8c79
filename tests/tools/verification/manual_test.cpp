// The verification manual: its table, what is computed, what is red, the page, and the command.

#include "verification/manual.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <set>

#include "cli/failures.h"
#include "cli/json.h"
#include "report/page.h"
#include "tools/program.h"

using namespace talus;
using namespace talus::tools;
using namespace talus::tools::testing;

namespace {

const std::filesystem::path kBench = std::filesystem::path(TALUS_SOURCE_DIR) / "bench";
constexpr const char* kHead =
    "section,name,scenario,set,quantity,reference,low,high,kind,seconds,source,others,found,why\n";

/// Rows of the manual that are wanted, computed.
Manual computed(const std::string& rows) {
    const std::atomic<bool> stop = false;
    return {.rows = verify(readRows(kHead + rows, "rows.csv"), 2, stop, {}),
            .quick = false,
            .interrupted = false,
            .wall_seconds = 0,
            .provenance = Json::object()};
}

/// Message of the fault that a table has.
std::string faultOf(const std::string& row) {
    try {
        readRows(kHead + row, "rows.csv");
    } catch (const BadInput& bad) {
        return bad.errors.front().file + ":" + std::to_string(bad.errors.front().line) + " " +
               bad.errors.front().field;
    }
    return "";
}

}  // namespace

TEST_CASE("verification rows: every scenario of bench/verification and of the paper's tables has its row") {
    std::set<std::string> named;
    for (const VerificationRow& row : verificationRows()) {
        CAPTURE(row.name);
        CHECK_NOTHROW(scenarioText(row));
        CHECK_FALSE(row.source.empty());
        named.insert(row.scenario);
    }
    // Pictures of the paper's Figs. 4 and 5, and the study of contact points that talus paper shows: no
    // figure to meet.
    const std::set<std::string> shown{"verification/run-on-dry", "verification/run-on-fissure-5",
                                      "paper/lp-study"};
    for (const char* folder : {"verification", "paper"})
        for (const auto& file : std::filesystem::directory_iterator(kBench / folder)) {
            if (file.path().extension() != ".toml") continue;
            const std::string name = folder + ("/" + file.path().stem().string());
            CAPTURE(name);
            CHECK(named.contains(name) != shown.contains(name));
        }
}

TEST_CASE(
    "verification rows: the table is the one in bench/, and bands hold their references where they are "
    "exact") {
    const auto built_in = verificationRows();
    const auto from_file = readRows(contentOf(kBench / "verification/rows.csv"), "rows.csv");
    REQUIRE(built_in.size() == from_file.size());
    std::set<std::string> names;
    for (const VerificationRow& row : built_in) {
        CAPTURE(row.name);
        CHECK(names.insert(row.section + row.name + row.quantity).second);
        if (row.kind == "closed_form" && row.judged() && row.high)
            CHECK((row.reference >= *row.low && row.reference <= *row.high));
    }
}

TEST_CASE("verification rows: faults of the table name their line") {
    CHECK(faultOf("A,b,c,,d,1,1,1,closed_form,1,e,,,\n") == "");
    CHECK(faultOf("A,b,c,,d,x,1,1,closed_form,1,e,,,\n") == "rows.csv:2 reference");
    CHECK(faultOf("A,b,c,,d,1,1,,closed_form,1,e,,,\n") == "rows.csv:2 high");
    CHECK(faultOf("A,b,c,,d,1,1,1,guess,1,e,,,\n") == "rows.csv:2 kind");
    CHECK(faultOf("A,b,c\n") == "rows.csv:2 ");
}

TEST_CASE("verification: values, bands and verdicts") {
    const std::string plane = "verification/plane-slides-at-friction-angle";
    const Manual manual = computed(
        "A,right," + plane + ",,critical_angle_deg,30,29.975,30.025,closed_form,1,s,,,\n" + "A,wrong," +
        plane + ",,critical_angle_deg,31,30.9,31.1,closed_form,1,s,,,\n" + "A,changed," + plane +
        ",[joint.default] friction_deg = 25.0,critical_angle_deg,25,24.975,25.025,closed_form,1,s,,,\n" +
        "A,beside," + plane + ",,critical_angle_deg,20,,,laboratory,1,s,,,\n" + "A,stands," + plane +
        ",,falls_at_start,0,0,0,bound,1,s,,,\n" + "A,limit," + plane +
        ",,limit_tilt_deg,30,29.99,30.01,bound,1,s,,,\n" +
        "A,ceiling,verification/wedge-phi-40,,safety_factor,1.27463,1.27,ceiling,published,1,s,,,\n" +
        "A,speed,verification/plane-acceleration,,speed_m_s,1.82,1.81,1.83,closed_form,1,s,,,\n");
    REQUIRE(manual.rows.size() == 8);
    for (const VerifiedRow& row : manual.rows) {
        CAPTURE(row.what.name);
        CAPTURE(row.computed->status);
        REQUIRE(row.value.has_value());
        CHECK(row.ok() == (row.what.name != "wrong"));
    }
    CHECK(manual.outside() == 1);
    CHECK(manual.judged() == 7);
    CHECK(manual.rows[0].computed == manual.rows[1].computed);  // one computation serves both
    CHECK(manual.rows[2].computed != manual.rows[0].computed);
    CHECK(*manual.rows[6].high > 1.2754);
    CHECK(*manual.rows[6].high < 1.2746 * 1.15);

    const Json json = manualJson(manual);
    for (const char* key : {"name", "quantity", "reference", "source", "kind", "value", "difference", "low",
                            "high", "ok", "wall_seconds"})
        CHECK(json["rows"][0].contains(key));
    CHECK(json["rows"][1]["ok"] == false);
    CHECK(json["rows"][3]["low"].is_null());

    const std::string csv = manualCsv(manual);
    CHECK(std::count(csv.begin(), csv.end(), '\n') == 9);

    const Json report = manualReport(manual);
    CHECK(report["sections"][0]["id"] == "outside");
    const Json& table = report["sections"][1]["blocks"][0];
    CHECK(table["alerts"] == Json::array({1}));
    const Json& pictures = report["sections"][1]["blocks"][1]["items"];
    REQUIRE(pictures.size() == 4);  // of the plane, the changed one, the wedge, the acceleration
    CHECK(pictures[0]["links"][0]["href"] == "scenarios/plane-slides-at-friction-angle.toml");
    CHECK(pictures[0]["shapes"].size() == 2);
    CHECK(manualText(manual).find("! wrong") != std::string::npos);
}

TEST_CASE("verification: whether a search ends with an answer is a value, too, also of an example") {
    const Manual manual =
        computed("A,plane,verification/plane-slides-at-friction-angle,,decided,1,1,1,bound,1,s,,,\n");
    REQUIRE(manual.rows[0].value.has_value());
    CHECK(*manual.rows[0].value == 1);
    const auto rows =
        readRows(std::string(kHead) + "A,rock,examples/rock-slope,,decided,1,1,1,bound,1,s,,,\n", "rows.csv");
    CHECK(scenarioText(rows[0]) == contentOf(kBench / "examples/rock-slope.toml"));
}

TEST_CASE("verification: a row may be outside with the value that the table states, and with no other") {
    const std::string plane = "A,x,verification/plane-slides-at-friction-angle,,critical_angle_deg,31,";
    const auto row = [&](const std::string& rest) {
        const Manual manual = computed(plane + rest + "\n");
        CHECK(manual.unexpected() == (manual.rows[0].asStated() ? 0u : 1u));
        return manual.rows[0];
    };
    const VerifiedRow known = row("30.9,31.1,closed_form,1,s,,30.0,softer than the reference");
    CHECK_FALSE(known.ok());
    CHECK(known.asStated());
    CHECK_FALSE(row("30.9,31.1,closed_form,1,s,,30.1,softer than the reference").asStated());  // has moved
    CHECK_FALSE(row("30.9,31.1,closed_form,1,s,,,").asStated());  // newly outside
    CHECK_FALSE(row("29.9,31.1,closed_form,1,s,,29.5,softer than the reference").asStated());  // inside again
    CHECK(faultOf("A,b,c,,d,1,1,1,closed_form,1,e,,2,\n") == "rows.csv:2 why");
    CHECK(faultOf("A,b,c,,d,1,,,closed_form,1,e,,2,reason\n") == "rows.csv:2 found");
}

TEST_CASE("verification: a value that cannot be had is outside, and says why") {
    const Manual manual = computed("A,none,verification/arch-27-1.05m,,limit_tilt_deg,1,0,2,bound,1,s,,,\n");
    REQUIRE(manual.rows.size() == 1);
    CHECK_FALSE(manual.rows[0].value.has_value());
    CHECK_FALSE(manual.rows[0].ok());
    CHECK(manual.rows[0].computed->status == "unstable_at_start");
}

TEST_CASE(
    "talus verification: the command writes page, table and scenarios; its exit code says whether all is "
    "inside") {
    const TemporaryFolder folder;
    const Outcome outcome = runTalus({"verification", "--only", "verification/overturns", "--out",
                                      folder / "out", "--json", "--threads", "2"});
    REQUIRE(outcome.exit_code == 0);
    const auto json = outcome.json();
    REQUIRE(json["rows"].size() == 2);
    CHECK(json["outside"] == 0);
    for (const auto& row : json["rows"]) {
        CHECK(row["ok"] == true);
        CHECK(std::abs(row["difference"].get<double>()) < 0.025);
    }
    CHECK(contentOf(folder / "out/index.html").find("overturns-0.4") != std::string::npos);
    CHECK(contentOf(folder / "out/rows.csv").find("closed_form") != std::string::npos);
    CHECK(contentOf(folder / "out/scenarios/overturns-0.4.toml") ==
          contentOf(kBench / "verification/overturns-0.4.toml"));
    CHECK(runTalus({"verification", "--only", "no such row", "--out", folder / "out"}).exit_code == 2);
}

TEST_CASE("talus verification: rows that are outside end it with exit code 1") {
    const TemporaryFolder folder;
    // Above the closed form of limiting friction by 1.2 %, as the table says.
    const Outcome outcome = runTalus(
        {"verification", "--only", "goodman-bray-slice-38.15", "--out", folder / "out", "--json", "--quiet"});
    const auto json = outcome.json();
    const bool all_inside = json["outside"] == 0;
    CHECK(outcome.exit_code == (all_inside ? 0 : 1));
    REQUIRE(json["rows"].size() == 2);
    for (const auto& row : json["rows"]) CHECK((row["ok"] == true || !row["why"].get<std::string>().empty()));
    const Outcome stated = runTalus({"verification", "--only", "goodman-bray-slice-38.15", "--out",
                                     folder / "out", "--json", "--quiet", "--accept-stated"});
    CHECK(stated.exit_code == 0);
    CHECK(stated.json()["unexpected"] == 0);
    CHECK(contentOf(folder / "out/index.html").find("limiting friction on every side") != std::string::npos);
}

TEST_SUITE("slow: verification") {
    TEST_CASE(
        "talus verification: the rows that take seconds are inside their bands, or outside as the table "
        "states") {
        std::vector<VerificationRow> rows = verificationRows();
        std::erase_if(rows, [](const VerificationRow& row) { return row.seconds > kQuickSeconds; });
        const std::atomic<bool> stop = false;
        const auto verified = verify(rows, 2, stop, {});
        REQUIRE(verified.size() == rows.size());
        for (const VerifiedRow& row : verified) {
            CAPTURE(row.what.name);
            CAPTURE(row.value.value_or(0));
            CAPTURE(row.what.reference);
            CHECK(row.asStated());
        }
    }
}
