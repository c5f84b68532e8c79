// glTF 2.0 in one binary file (.glb): a mesh per block in its own place, a node for each, and for a run an
// animation of the moving nodes. glTF's y points up, so the model's z is turned to it.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

#include "export/placed.h"
#include "export/role_colours.h"

namespace talus::formats {
namespace {

using Json = nlohmann::ordered_json;

// Numbers of the specification.
constexpr int kFloat = 5126, kUnsignedInt = 5125, kVertexBuffer = 34962, kIndexBuffer = 34963;
constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

/// The file as it grows: its JSON, and the buffer of all numbers.
class Gltf {
 public:
    Gltf() {
        json_ = {{"asset", {{"version", "2.0"}, {"generator", "Talus"}}},
                 {"scene", 0},
                 {"scenes", Json::array({{{"nodes", {0}}}})},
                 {"nodes", Json::array()},
                 {"materials", Json::array()},
                 {"meshes", Json::array()},
                 {"accessors", Json::array()},
                 {"bufferViews", Json::array()},
                 {"buffers", Json::array()}};
    }

    Json& operator[](const char* key) { return json_[key]; }

    std::size_t add(const char* list, Json what) {
        json_[list].push_back(std::move(what));
        return json_[list].size() - 1;
    }

    /// An accessor of `parts` floats an element; \param bounds says their smallest and largest, where glTF
    /// wants to know
    std::size_t addFloats(const std::vector<float>& values, std::size_t parts, bool bounds, int target = 0) {
        static constexpr const char* kTypes[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
        Json accessor{{"bufferView", addView(values.data(), values.size() * sizeof(float), target)},
                      {"componentType", kFloat},
                      {"count", values.size() / parts},
                      {"type", kTypes[parts]}};
        if (bounds) addBounds(values, parts, accessor);
        return add("accessors", std::move(accessor));
    }

    std::size_t addIndices(const std::vector<std::uint32_t>& values) {
        return add(
            "accessors",
            {{"bufferView", addView(values.data(), values.size() * sizeof(std::uint32_t), kIndexBuffer)},
             {"componentType", kUnsignedInt},
             {"count", values.size()},
             {"type", "SCALAR"}});
    }

    std::string file() {
        json_["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
        std::string text = json_.dump(-1, ' ', false, Json::error_handler_t::replace);
        text.resize((text.size() + 3) / 4 * 4, ' ');
        std::string out;
        const auto put = [&](std::size_t value) {
            const auto word = static_cast<std::uint32_t>(value);
            out.append(reinterpret_cast<const char*>(&word), sizeof word);
        };
        put(kMagic), put(kVersion), put(12 + 8 + text.size() + 8 + binary_.size());
        put(text.size()), put(kJsonChunk), out += text;
        put(binary_.size()), put(kBinaryChunk), out += binary_;
        return out;
    }

 private:
    std::size_t addView(const void* data, std::size_t bytes, int target) {
        Json view{{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes}};
        if (target != 0) view["target"] = target;
        binary_.append(static_cast<const char*>(data), bytes);
        return add("bufferViews", std::move(view));
    }

    static void addBounds(const std::vector<float>& values, std::size_t parts, Json& accessor) {
        std::vector<float> low(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(parts)),
            high = low;
        for (std::size_t k = 0; k < values.size(); ++k) {
            low[k % parts] = std::min(low[k % parts], values[k]);
            high[k % parts] = std::max(high[k % parts], values[k]);
        }
        accessor["min"] = low, accessor["max"] = high;
    }

    Json json_;
    std::string binary_;
};

void append(std::vector<float>& flat, const Vec3& v) {
    for (const double part : {v.x(), v.y(), v.z()}) flat.push_back(static_cast<float>(part));
}

/// Quaternion x, y, z, w of a rotation vector [rad].
Eigen::Quaterniond quaternionOf(const Vec3& rotation) {
    const double angle = rotation.norm();
    if (angle == 0) return Eigen::Quaterniond::Identity();
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, rotation / angle));
}

/// sRGB to the linear values that glTF asks for.
double linear(std::uint8_t part) { return std::pow(part / 255.0, 2.2); }

std::size_t materialOf(Gltf& gltf, const RoleColour& colour, std::map<RoleColour, std::size_t>& known) {
    const auto [place, is_new] = known.try_emplace(colour, known.size());
    if (is_new)
        gltf.add("materials",
                 {{"pbrMetallicRoughness",
                   {{"baseColorFactor", {linear(colour[0]), linear(colour[1]), linear(colour[2]), 1.0}},
                    {"metallicFactor", 0.0},
                    {"roughnessFactor", 0.9}}}});
    return place->second;
}

/// A block about its centroid, faces as fans of triangles. No normals: its faces are flat.
std::size_t addMesh(Gltf& gltf, const RunGeometry& g, std::size_t b, std::size_t material) {
    std::vector<float> places;
    const auto first = g.vertex_begin[b];
    for (auto v = first; v < g.vertex_begin[b + 1]; ++v)
        append(places, at(g.vertex, static_cast<std::size_t>(v)) - at(g.centroid, b));
    std::vector<std::uint32_t> corners;
    for (auto f = static_cast<std::size_t>(g.face_begin[b]);
         f < static_cast<std::size_t>(g.face_begin[b + 1]); ++f) {
        if (g.isInner(f)) continue;
        const auto corner = [&](std::int32_t k) {
            return static_cast<std::uint32_t>(g.face_vertex[static_cast<std::size_t>(k)] - first);
        };
        for (auto k = g.face_vertex_begin[f] + 2; k < g.face_vertex_begin[f + 1]; ++k)
            corners.insert(corners.end(), {corner(g.face_vertex_begin[f]), corner(k - 1), corner(k)});
    }
    Json primitive{{"attributes", {{"POSITION", gltf.addFloats(places, 3, true, kVertexBuffer)}}},
                   {"indices", gltf.addIndices(corners)},
                   {"material", material}};
    return gltf.add("meshes", {{"primitives", Json::array({std::move(primitive)})}});
}

bool moves(const std::vector<LightFrame>& frames, std::size_t b) {
    return std::any_of(frames.begin(), frames.end(), [&](const LightFrame& frame) {
        return at(frame.displacement, b) != at(frames.front().displacement, b) ||
               at(frame.rotation, b) != at(frames.front().rotation, b);
    });
}

/// The path of one block through the frames: a channel each for translation and rotation.
void addChannels(Gltf& gltf, Json& animation, const std::vector<LightFrame>& frames, std::size_t b,
                 const Vec3& start, std::size_t node, std::size_t times) {
    std::vector<float> places, turns;
    Eigen::Quaterniond last = Eigen::Quaterniond::Identity();
    for (const LightFrame& frame : frames) {
        append(places, start + at(frame.displacement, b));
        Eigen::Quaterniond turn = quaternionOf(at(frame.rotation, b));
        if (turn.dot(last) < 0) turn.coeffs() = -turn.coeffs();  // the shorter way from frame to frame
        for (const double part : {turn.x(), turn.y(), turn.z(), turn.w()})
            turns.push_back(static_cast<float>(part));
        last = turn;
    }
    const auto channel = [&](const char* path, std::size_t output) {
        const std::size_t sampler = animation["samplers"].size();
        animation["samplers"].push_back({{"input", times}, {"output", output}, {"interpolation", "LINEAR"}});
        animation["channels"].push_back({{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}});
    };
    channel("translation", gltf.addFloats(places, 3, false));
    channel("rotation", gltf.addFloats(turns, 4, false));
}

Json blockNode(const SnapshotHeader& header, const LightFrame& frame, std::size_t b, const Vec3& start,
               std::size_t mesh) {
    const Vec3 place = start + at(frame.displacement, b);
    const Eigen::Quaterniond turn = quaternionOf(at(frame.rotation, b));
    return {{"name", header.names[b]},
            {"mesh", mesh},
            {"translation", {place.x(), place.y(), place.z()}},
            {"rotation", {turn.x(), turn.y(), turn.z(), turn.w()}}};
}

}  // namespace

std::string gltfBlocks(const SnapshotHeader& header, const std::vector<LightFrame>& frames) {
    const RunGeometry& g = header.geometry;
    const std::vector<FailureMode> roles = failureRoles(header, frames.back());
    // Floats resolve little in survey coordinates, so places count from the first block, whose own place is
    // exact.
    const Vec3 origin = at(g.centroid, 0);
    Gltf gltf;
    Json children = Json::array();
    const double half = std::sqrt(0.5);
    gltf.add("nodes", {{"name", "model, z up"}, {"rotation", {-half, 0, 0, half}}, {"children", {1}}});
    gltf.add("nodes", {{"name", "origin"}, {"translation", {origin.x(), origin.y(), origin.z()}}});
    std::vector<float> times;
    for (const LightFrame& frame : frames) times.push_back(static_cast<float>(frame.time));
    const bool animated = frames.size() > 1;
    const std::size_t clock = animated ? gltf.addFloats(times, 1, true) : 0;
    Json animation{{"name", "run"}, {"channels", Json::array()}, {"samplers", Json::array()}};
    std::map<RoleColour, std::size_t> materials;
    for (std::size_t b = 0; b < header.names.size(); ++b) {
        const Vec3 start = at(g.centroid, b) - origin;
        const std::size_t material = materialOf(gltf, colourOf(header.motions[b], roles[b]), materials);
        const std::size_t mesh = addMesh(gltf, g, b, material);
        const std::size_t node = gltf.add("nodes", blockNode(header, frames.front(), b, start, mesh));
        children.push_back(node);
        if (moves(frames, b)) addChannels(gltf, animation, frames, b, start, node, clock);
    }
    gltf["nodes"][1]["children"] = children;
    if (!animation["channels"].empty()) gltf["animations"] = Json::array({std::move(animation)});
    return gltf.file();
}

}  // namespace talus::formats
