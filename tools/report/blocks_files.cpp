#include "report/blocks_files.h"

#include <algorithm>
#include <charconv>

namespace talus::tools {

namespace {

/// The shortest text that reads back as the same number.
void append(std::string& out, double value) {
    char buffer[32];
    out.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

const char* motionName(Motion motion) {
    return motion == Motion::fixed ? "fixed" : motion == Motion::driven ? "driven" : "free";
}

/// Quoted where CSV asks for it.
std::string csvField(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

}  // namespace

double blockThickness(const Polyhedron& shape) {
    double thinnest = kInfinity;
    for (std::size_t f = 0; f < shape.faces.size(); ++f) {
        const Vec3 normal = shape.faceNormal(f);
        double low = kInfinity, high = -kInfinity;
        for (const Vec3& v : shape.vertices) {
            low = std::min(low, normal.dot(v));
            high = std::max(high, normal.dot(v));
        }
        thinnest = std::min(thinnest, high - low);
    }
    return thinnest;
}

std::string blocksObj(const Model& model, std::string_view comments) {
    std::string out(comments);
    std::size_t before = 1;  // OBJ counts from 1
    for (const Block& block : model.blocks) {
        out += "o " + block.name + "\n";
        for (const Vec3& v : block.shape.vertices) {
            out += "v ";
            append(out, v.x());
            out += ' ';
            append(out, v.y());
            out += ' ';
            append(out, v.z());
            out += '\n';
        }
        for (const auto& face : block.shape.faces) {
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
        out += csvField(block.name) + "," + motionName(block.motion);
        for (const double value : {mass.volume, mass.centroid.x(), mass.centroid.y(), mass.centroid.z()}) {
            out += ',';
            append(out, value);
        }
        out += "," + std::to_string(block.shape.faces.size()) + ",";
        append(out, blockThickness(block.shape));
        out += '\n';
    }
    return out;
}

}  // namespace talus::tools
