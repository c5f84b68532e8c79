// Rows of CSV, written and read.

#include "report/csv.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace talus::tools;

TEST_CASE("CSV fields are quoted when they have to be") {
    CHECK(csvField("plain") == "plain");
    CHECK(csvField("a,b") == "\"a,b\"");
    CHECK(csvField("say \"x\"") == "\"say \"\"x\"\"\"");
    CHECK(csvField("two\nlines") == "\"two lines\"");
}

TEST_CASE("a name that a spreadsheet would compute is text, and reads back as it was") {
    CHECK(csvField("=cmd|' /C calc'!A0") == "'=cmd|' /C calc'!A0");
    CHECK(csvField("@SUM(1,2)") == "\"'@SUM(1,2)\"");
    CHECK(csvField("-1.5e-3") == "-1.5e-3");
    const std::vector<std::string> fields = {"=1+1", "'=1+1", "''-x",    "+a", "-b",
                                             "@c",   "-1.5",  "'quoted", "'"};
    std::string line = csvLine(fields);
    line.pop_back();
    CHECK(csvFields(line) == fields);
}

TEST_CASE("a line of CSV reads back as its fields") {
    const std::vector<std::string> fields = {"", "a,b", "say \"x\"", "\"", "plain", ""};
    std::string line = csvLine(fields);
    REQUIRE(line.ends_with('\n'));
    line.pop_back();
    CHECK(csvFields(line) == fields);
}

TEST_CASE("numbers read back to the last bit, and only whole fields are numbers") {
    for (const double value : {0.1, -1e-300, 1.0 / 3, 6.02214076e23, 0.0})
        CHECK(numberIn(csvNumber(value)) == value);
    CHECK(csvNumber(std::nan("")).empty());
    CHECK(csvNumber(std::numeric_limits<double>::infinity()).empty());
    for (const char* field : {"", "12 m", "x", "1,5"}) CHECK_FALSE(numberIn(field).has_value());
}
