// libFuzzer: any bytes as a mesh, a height grid or points. The first one says of which format, a capital: as
// an open terrain that is mended, closed and simplified; behind it `+` asks for each solid by itself. What is
// taken are closed surfaces.

#include <algorithm>
#include <string_view>

#include "talus/formats/mesh.h"

using namespace talus;
using namespace talus::formats;

namespace {

void readEachSolid(const std::string& bytes, const MeshOptions& options) {
    const auto solids = parseSolids(bytes, "fuzz", options);
    if (!solids) return;
    for (const auto& solid : solids->solids)
        if (!checkSurface(solid.surface).empty()) __builtin_trap();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::string_view kFormats = "sopadxSOPADX";  // in the order of MeshFormat
    const std::size_t chosen = size == 0 ? std::string_view::npos : kFormats.find(static_cast<char>(data[0]));
    if (chosen == std::string_view::npos) return 0;
    const bool is_each = size > 1 && data[1] == '+';
    const std::size_t head = is_each ? 2 : 1;
    const std::string bytes(reinterpret_cast<const char*>(data) + head, size - head);
    MeshOptions options;
    options.format = static_cast<MeshFormat>(static_cast<std::size_t>(MeshFormat::stl) + chosen % 6);
    if (options.format == MeshFormat::xyz) options.cell = 1;
    if (chosen >= 6) {
        options.base = -100;
        options.simplify = 0.1;
        options.mend = true;
        options.largest_hole = 10;
    }
    if (is_each) return readEachSolid(bytes, options), 0;
    const auto mesh = parseMesh(bytes, "fuzz", options);
    if (mesh && !checkSurface(mesh->surface).empty()) __builtin_trap();
    return 0;
}
