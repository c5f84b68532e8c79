// libFuzzer: any bytes as a table. The first one says which: cases of a sweep (c), fractures (f), a ground
// motion (g), poles (p).

#include <cmath>

#include "scenario/ground_motion.h"
#include "sweep/case_table.h"
#include "talus/formats/fractures.h"
#include "talus/formats/poles.h"

using namespace talus;
using namespace talus::formats;

namespace {

void readCases(const std::string& text) {
    const auto cases = sweep::parseCases(text, "fuzz.csv");
    if (!cases) return;
    for (const auto& row : cases->rows)
        if (row.size() != cases->header.size()) __builtin_trap();
}

/// What is read can be written, and reads back as the same bits but for the rounding of degrees.
void readDiscs(const std::string& text) {
    const auto discs = parseFractures(text, "fuzz.csv");
    if (!discs) return;
    std::vector<std::pair<std::string, Fracture>> named;
    for (const Fracture& disc : *discs) named.emplace_back("=a, \"b\"", disc);
    const auto again = parseFractures(fracturesCsv(named), "again.csv");
    if (!again || again->size() != discs->size()) __builtin_trap();
    for (std::size_t k = 0; k < discs->size(); ++k)
        if ((*again)[k].centre != (*discs)[k].centre || (*again)[k].radius != (*discs)[k].radius)
            __builtin_trap();
}

/// What is read are planes.
void readPlanes(const std::string& text) {
    const auto table = parsePoles(text, "fuzz.csv");
    if (!table.ok() && table.errors().empty()) __builtin_trap();
    if (!table) return;
    for (const MeasuredPole& pole : table->poles)
        if (!(std::abs(pole.normal.norm() - 1) < 1e-9) || !(pole.weight > 0)) __builtin_trap();
}

void readRecord(const std::string& text) {
    for (const auto baseline : {scenario::Baseline::none, scenario::Baseline::line}) {
        std::string fault;
        const auto motion = scenario::parseGroundMotion(text, 1.5, baseline, fault);
        if (motion.has_value() != fault.empty()) __builtin_trap();
        if (motion && motion->time.size() != motion->acceleration.size()) __builtin_trap();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
    if (data[0] == 'c') readCases(text);
    if (data[0] == 'f') readDiscs(text);
    if (data[0] == 'g') readRecord(text);
    if (data[0] == 'p') readPlanes(text);
    return 0;
}
