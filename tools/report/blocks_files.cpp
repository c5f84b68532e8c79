#include "report/blocks_files.h"

#include "report/csv.h"

namespace talus::tools {

namespace {

const char* motionName(Motion motion) {
    return motion == Motion::fixed ? "fixed" : motion == Motion::driven ? "driven" : "free";
}

std::size_t surfaceFaces(const Polyhedron& shape) {
    std::size_t count = 0;
    for (std::size_t f = 0; f < shape.faces.size(); ++f) count += shape.isInner(f) ? 0 : 1;
    return count;
}

}  // namespace

std::string blocksObj(const Model& model, std::string_view comments) {
    std::string out(comments);
    std::size_t before = 1;  // OBJ counts from 1
    for (const Block& block : model.blocks) {
        out += "o " + block.name + "\n";
        for (const Vec3& v : block.shape.vertices) {
            out += "v " + csvNumber(v.x()) + " " + csvNumber(v.y()) + " " + csvNumber(v.z()) + "\n";
        }
        for (const auto& face : block.shape.faces) {  // of several parts each is closed
            out += 'f';
            for (const std::int32_t v : face)
                out += ' ' + std::to_string(before + static_cast<std::size_t>(v));
            out += '\n';
        }
        before += block.shape.vertices.size();
    }
    return out;
}

std::string blocksCsv(const Model& model, std::string_view comments) {
    std::string out = std::string(comments) + "name,motion,volume_m3,x_m,y_m,z_m,faces,thickness_m\n";
    for (const Block& block : model.blocks) {
        const MassProperties mass = massProperties(block.shape);
        out +=
            csvLine({block.name, motionName(block.motion), csvNumber(mass.volume),
                     csvNumber(mass.centroid.x()), csvNumber(mass.centroid.y()), csvNumber(mass.centroid.z()),
                     std::to_string(surfaceFaces(block.shape)), csvNumber(smallestExtent(block.shape))});
    }
    return out;
}

}  // namespace talus::tools
