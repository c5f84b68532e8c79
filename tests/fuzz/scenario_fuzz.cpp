// libFuzzer: any bytes as a scenario file.

#include <cstddef>
#include <cstdint>
#include <string>

#include "talus/formats/scenario.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    const auto scenario = talus::formats::parseScenario(text, "fuzz.toml");
    for (const talus::Error& error : scenario.errors()) talus::formats::format(error);
    return 0;
}
