// Progress: the time left, and a line for any terminal.

#include "cli/progress.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>

#include "cli/terminal.h"
#include "support/properties.h"

using namespace talus;
using namespace talus::tools;

namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// The largest factor by which what is told is wrong, of a stage of 100 s whose fraction grows so.
double worstFactor(const std::function<double(double)>& fraction) {
    TimeLeft left;
    double worst = 1;
    for (double t = 0; t < 90; t += 0.5) {
        const auto told = left.after(t, fraction(t));
        if (told && t > 10) worst = std::max({worst, *told / (100 - t), (100 - t) / *told});
    }
    return worst;
}

}  // namespace

TEST_SUITE("progress") {
    TEST_CASE("the time left is right within a factor of two, also where work becomes dearer or cheaper") {
        CHECK(worstFactor([](double t) { return t / 100; }) < 1.01);
        CHECK(worstFactor([](double t) { return std::pow(t / 100, 1.3); }) < 2);
        CHECK(worstFactor([](double t) { return std::pow(t / 100, 0.7); }) < 2);
        // Half as fast from the middle on.
        CHECK(worstFactor([](double t) { return t < 50 ? t * 2 / 150 : (t + 50) / 150; }) < 2.001);
    }

    TEST_CASE("no time is shown at first, or while the fraction is constant") {
        TimeLeft left;
        CHECK_FALSE(left.after(0, 0.0));
        CHECK_FALSE(left.after(0.5, 0.3));
        CHECK(left.after(10, 0.5));
        TimeLeft still;
        for (double t = 0; t < 100; t += 1) CHECK_FALSE(still.after(t, 0.4));
    }

    TEST_CASE("a line fits any terminal and always has the clock") {
        test::checkProperty("columns of a progress line", 300, [] {
            const auto columns = static_cast<std::size_t>(*rc::gen::inRange(24, 200));
            Progress progress;
            progress.stage = *rc::gen::element<std::string>("run", "settling", "another loading history");
            progress.fraction = *test::numberIn(0, 1);
            progress.detail =
                *rc::gen::element<std::string>("", "t = 0.1 s", "tilt 19.53 deg, failing, or not");
            const double left = *rc::gen::element(kUnknown, 5.0, 500'000.0);
            const std::string line = progressLine(progress, *test::numberIn(0, 9000), left, columns);
            RC_ASSERT(line.size() <= columns);
            RC_ASSERT(line.find(':') != std::string::npos);
        });
        const Progress search{"settling", 0.2, "tilt 19.53 deg"};
        CHECK(progressLine(search, 14, kUnknown, 50) == "20% settling  0:14 elapsed  tilt 19.53 deg");
        CHECK(progressLine(search, 14, kUnknown, 50).find("left") == std::string::npos);
        // What does not fit is left out by its parts, not in the middle of a word.
        const Progress probe{"probe 12", 0.83, "tilt 12.4860 deg, stable"};
        CHECK(progressLine(probe, 3, kUnknown, 49) == "83% probe 12  0:03 elapsed  tilt 12.4860 deg");
        CHECK(progressLine(probe, 3, kUnknown, 52) == "83% probe 12  0:03 elapsed  tilt 12.4860 deg, stable");
        CHECK(progressLine(probe, 3, kUnknown, 43) == "83% probe 12  0:03 elapsed  tilt 12.4860");
    }

    TEST_CASE("text is wrapped at words, and examples are indented") {
        test::checkProperty("width of wrapped text", 100, [] {
            const auto width = static_cast<std::size_t>(*rc::gen::inRange(20, 100));
            std::istringstream lines(
                wrapped("Example:\n  talus run slope.toml -o run.mcap --threads 2\n\nA long line of "
                        "words that goes on\nin the next one.\n",
                        width, 4));
            for (std::string line; std::getline(lines, line);) RC_ASSERT(line.size() <= width);
        });
        CHECK(wrapped("one two\nthree", 40) == "one two three\n");
        CHECK(wrapped("  one two three", 10) == "  one two\n      three\n");
    }
}
