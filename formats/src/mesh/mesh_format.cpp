#include "mesh/mesh_format.h"

#include <algorithm>
#include <utility>

#include "toml/wording.h"

namespace talus::formats::mesh {

namespace {

/// Options that only some formats have.
std::optional<Error> optionFault(MeshFormat format, const MeshOptions& options) {
    if (format == MeshFormat::xyz && !options.cell) {
        return Error{
            "cell_m",
            "found points without a cell size, allowed: the side of the cells they are thinned to [m]"};
    }
    if (format != MeshFormat::xyz && options.cell)
        return Error{"cell_m", "found a cell size for a mesh, allowed: only for points (.xyz)"};
    if (format != MeshFormat::xyz && options.median)
        return Error{"cell_height", "found a height of cells for a mesh, allowed: only for points (.xyz)"};
    if (format != MeshFormat::dxf && options.layer)
        return Error{"layer", "found a layer for a file without layers, allowed: only for .dxf"};
    return std::nullopt;
}

}  // namespace

Error unknownEnding(const std::string& path) {
    return {"", "found " + toml::quoted(path) +
                    ", allowed: a file that ends in .stl, .obj, .ply, .dxf, .asc or .xyz"};
}

MeshFormat formatOf(const std::string& path, MeshFormat format) {
    if (format != MeshFormat::by_name) return format;
    std::string end = path.substr(path.size() - std::min<std::size_t>(4, path.size()));
    for (char& c : end) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    constexpr std::pair<std::string_view, MeshFormat> kEndings[]{
        {".stl", MeshFormat::stl}, {".obj", MeshFormat::obj}, {".ply", MeshFormat::ply},
        {".asc", MeshFormat::asc}, {".dxf", MeshFormat::dxf}, {".xyz", MeshFormat::xyz}};
    for (const auto& [ending, known] : kEndings)
        if (end == ending) return known;
    return format;
}

Result<FileSurface> surfaceOf(const std::string& bytes, const std::string& path, const MeshOptions& options) {
    const MeshFormat format = formatOf(path, options.format);
    if (format == MeshFormat::by_name) return unknownEnding(path);
    if (auto fault = optionFault(format, options)) return *fault;
    switch (format) {
        case MeshFormat::stl:
            return readStl(bytes, SurfaceBuilder(path));
        case MeshFormat::obj:
            return readObj(bytes, SurfaceBuilder(path));
        case MeshFormat::ply:
            return readPly(bytes, SurfaceBuilder(path));
        case MeshFormat::asc:
            return readAsc(bytes, SurfaceBuilder(path));
        case MeshFormat::dxf:
            return readDxf(bytes, options.layer, SurfaceBuilder(path));
        case MeshFormat::xyz:
            return readXyz(bytes, {*options.cell / options.scale, options.median}, SurfaceBuilder(path));
        case MeshFormat::by_name:
            break;
    }
    return unknownEnding(path);
}

}  // namespace talus::formats::mesh
