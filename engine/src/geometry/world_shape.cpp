#include "geometry/world_shape.h"

#include <algorithm>

namespace talus {
namespace {

/// An edge as one of its faces lists it. A whole number sorts faster than three, by lower vertex, higher
/// vertex and face.
class HalfEdge {
 public:
    HalfEdge(std::int32_t from, std::int32_t to, std::size_t face)
        : key_(static_cast<std::uint64_t>(std::min(from, to)) << 2 * kBits |
               static_cast<std::uint64_t>(std::max(from, to)) << kBits | face) {}

    std::int32_t low() const { return static_cast<std::int32_t>(key_ >> 2 * kBits); }
    std::int32_t high() const { return static_cast<std::int32_t>(key_ >> kBits & kMask); }
    std::int32_t face() const { return static_cast<std::int32_t>(key_ & kMask); }
    bool operator<(const HalfEdge& other) const { return key_ < other.key_; }

 private:
    static constexpr unsigned kBits = 21;  // of vertices and faces of one convex part
    static constexpr std::uint64_t kMask = (std::uint64_t{1} << kBits) - 1;
    std::uint64_t key_;
};

}  // namespace

std::vector<PartEdge> partEdges(std::span<const std::vector<std::int32_t>> faces) {
    std::vector<HalfEdge> halves;
    for (std::size_t face = 0; face < faces.size(); ++face) {
        const auto& outline = faces[face];
        for (std::size_t i = 0; i < outline.size(); ++i)
            halves.emplace_back(outline[i], outline[i + 1 < outline.size() ? i + 1 : 0], face);
    }
    std::sort(halves.begin(), halves.end());
    std::vector<PartEdge> edges;
    edges.reserve(halves.size() / 2);
    for (std::size_t i = 0; i + 1 < halves.size(); i += 2)  // each edge belongs to two faces
        edges.push_back({halves[i].low(), halves[i].high(), halves[i].face(), halves[i + 1].face()});
    return edges;
}

}  // namespace talus
