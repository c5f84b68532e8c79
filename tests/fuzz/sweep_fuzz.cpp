// libFuzzer: any bytes as a sweep file over a small scenario. A sweep that is taken has runs that are either
// refused, or can be written as the text of a scenario that reads back.

#include <memory>

#include "talus/formats/sweep.h"

using namespace talus::formats;

namespace {

constexpr const char* kScenario =
    "[gravity]\ntilt_deg = 10.0\n[run]\nduration_s = 0.1\n[material.rock]\ndensity = 2700.0\n"
    "[joint.default]\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\nfriction_deg = 30.0\ncohesion = 1e3\n"
    "[joint.weak]\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\nfriction_deg = 20.0\n"
    "[[stack]]\ncolumns = 2\nrows = 2\nslices = 1\nblock = [0.2, 0.1, 0.1]\n"
    "[[water]]\nfissure = 1\ndepth = 0.05\n";

void look(const Sweep& sweep, std::uint64_t index) {
    const SweepRun run = runOf(sweep, index);
    if (!scenarioOf(sweep, run).ok()) return;
    const auto text = scenarioTextOf(sweep, run);
    if (!text || !parseScenario(*text, "run.toml").ok()) __builtin_trap();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const auto scenario = std::make_shared<const Scenario>(*parseScenario(kScenario, "slope.toml"));
    const std::string text(reinterpret_cast<const char*>(data), size);
    const auto sweep = parseSweep(text, "fuzz.toml", scenario);
    for (const talus::Error& error : sweep.errors()) talus::formats::format(error);
    if (!sweep) return 0;
    identityOf(*sweep);
    for (const std::uint64_t index : {std::uint64_t{0}, sweep->runs() / 2, sweep->runs() - 1})
        look(*sweep, index);
    return 0;
}
