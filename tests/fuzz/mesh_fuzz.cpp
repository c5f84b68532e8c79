// libFuzzer: any bytes as a mesh or a height grid. The first one says of which format, a capital: as an open
// terrain that is closed, and simplified. What is taken is a closed surface.

#include <algorithm>
#include <string_view>

#include "talus/formats/mesh.h"

using namespace talus;
using namespace talus::formats;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::string_view kFormats = "sopaSOPA";
    const std::size_t chosen = size == 0 ? std::string_view::npos : kFormats.find(static_cast<char>(data[0]));
    if (chosen == std::string_view::npos) return 0;
    MeshOptions options;
    options.format = static_cast<MeshFormat>(static_cast<std::size_t>(MeshFormat::stl) + chosen % 4);
    if (chosen >= 4) {
        options.base = -100;
        options.simplify = 0.1;
    }
    const auto mesh = parseMesh({reinterpret_cast<const char*>(data) + 1, size - 1}, "fuzz", options);
    if (mesh && !checkSurface(mesh->surface).empty()) __builtin_trap();
    return 0;
}
