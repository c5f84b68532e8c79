// libFuzzer: any bytes as a scenario file.
//
// A legal scenario may ask for two million blocks in a few bytes, and 20,000 take half a minute under the
// sanitizers. What is looked for here shows with a few, so the reader gets a lower limit of its own kind.

#include <cstddef>
#include <cstdint>
#include <string>

#include "talus/formats/scenario.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::int64_t kMostBlocks = 1000;
    const std::string text(reinterpret_cast<const char*>(data), size);
    const auto scenario = talus::formats::parseScenario(text, "fuzz.toml", kMostBlocks);
    for (const talus::Error& error : scenario.errors()) talus::formats::format(error);
    return 0;
}
