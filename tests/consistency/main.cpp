// talus-consistency: draws small models of eight kinds and compares the program's answers about each with
// each other, with limit analysis, with closed formulas and with time histories. `talus-consistency 25 1 out`
// draws 25 of each kind from seed 1, and writes those that contradict themselves or are undecided into the
// folder `out`. With `--run` as the fourth argument each model is also run just below and just above its
// critical angle.

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "support/consistency.h"
#include "support/drawn_models.h"
#include "talus/formats/scenario.h"

using namespace talus;
using namespace talus::test;

namespace {

void print(const std::vector<std::string>& lines, const char* what) {
    for (const std::string& line : lines) std::printf("    %s: %s\n", what, line.c_str());
}

}  // namespace

int main(int count, char** arguments) {
    const auto argument = [&](int k, const char* otherwise) { return k < count ? arguments[k] : otherwise; };
    const unsigned draws = static_cast<unsigned>(std::atoi(argument(1, "25")));
    if (draws == 0) {
        std::fputs("usage: talus-consistency [DRAWS [SEED [FOLDER [--run]]]]\n", stderr);
        return 2;
    }
    const unsigned first = static_cast<unsigned>(std::atoi(argument(2, "1")));
    const std::filesystem::path folder = argument(3, "");
    const bool with_history = std::string(argument(4, "")) == "--run";
    int models = 0, contradictory = 0, undecided = 0, different = 0;
    for (const ModelKind kind : kModelKinds)
        for (unsigned seed = first; seed < first + draws; ++seed) {
            const std::string text = drawnScenario(kind, seed);
            const auto scenario = formats::parseScenario(text, "drawn.toml");
            ++models;
            if (!scenario.ok()) {
                std::printf("%s %u: %s\n", nameOf(kind), seed, formats::format(scenario.errors()[0]).c_str());
                ++undecided;
                continue;
            }
            const Consistency found = checkConsistency(scenario->model, with_history);
            std::printf("%s %u: %s\n", nameOf(kind), seed, found.answers.c_str());
            print(found.contradictions, "contradiction");
            print(found.undecided, "undecided");
            print(found.differences, "differs");
            std::fflush(stdout);
            contradictory += !found.contradictions.empty();
            undecided += !found.undecided.empty();
            different += !found.differences.empty();
            if (folder.empty() || (found.contradictions.empty() && found.undecided.empty())) continue;
            std::filesystem::create_directories(folder);
            std::ofstream(folder / (nameOf(kind) + std::to_string(seed) + ".toml")) << text;
        }
    std::printf("%d models: %d contradict themselves, %d undecided, %d differ where they may\n", models,
                contradictory, undecided, different);
    return contradictory + undecided > 0 ? 1 : 0;
}
