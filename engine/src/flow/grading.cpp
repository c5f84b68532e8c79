#include "flow/grading.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace talus::flow {
namespace {

// bench/studies/drain-in-a-joint.md has what other shares do to the discharge and to the number of triangles.
constexpr double kOfDistance = 0.5;  // longest side over the distance from the nearest corner, at most
constexpr double kOfSide = 0.125;    // longest side over the outline's own: not divided further

using Edge = std::pair<std::int32_t, std::int32_t>;  // lower node first

double distanceToSide(const Vec3& x, const Vec3& a, const Vec3& b) {
    const Vec3 along = b - a;
    const double place = std::clamp((x - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (a + place * along - x).norm();
}

class Grading {
 public:
    Grading(const Mesh& mesh, std::span<const OutlineCorner> corners) : mesh_(mesh), corners_(corners) {
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) enter(t);
    }

    void make() {
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
            while (isTooLarge(t)) divide(t);
    }

 private:
    Edge edge(std::size_t t, std::size_t k) const {
        return std::minmax({mesh_.triangles[t][k], mesh_.triangles[t][(k + 1) % 3]});
    }
    const Vec3& at(std::int32_t node) const { return mesh_.nodes[static_cast<std::size_t>(node)]; }
    double length(const Edge& e) const { return (at(e.second) - at(e.first)).norm(); }

    /// Of edges of one length, the one of later nodes: an order of all edges, so that `divide` ends.
    Edge longest(std::size_t t) const {
        Edge most = edge(t, 0);
        for (const std::size_t k : {1U, 2U}) {
            const Edge e = edge(t, k);
            if (std::pair(length(e), e) > std::pair(length(most), most)) most = e;
        }
        return most;
    }

    bool isTooLarge(std::size_t t) const {
        const double side = length(longest(t));
        return std::ranges::any_of(corners_, [&](const OutlineCorner& corner) {
            double distance = std::numeric_limits<double>::infinity();
            for (std::size_t k = 0; k < 3; ++k)
                distance = std::min(
                    distance, distanceToSide(corner.place, at(edge(t, k).first), at(edge(t, k).second)));
            return side > std::max(kOfSide * corner.side, kOfDistance * distance);
        });
    }

    /// Halves its longest side. Neighbours that have a longer one there are divided first.
    void divide(std::size_t t) {
        const Edge halved = longest(t);
        const auto other = std::ranges::find_if(
            triangles_on_[halved], [&](std::size_t neighbour) { return longest(neighbour) != halved; });
        if (other != triangles_on_[halved].end()) return divide(*other);
        const auto middle = static_cast<std::int32_t>(mesh_.nodes.size());
        mesh_.nodes.push_back(0.5 * (at(halved.first) + at(halved.second)));
        const std::vector<std::size_t> meet = std::exchange(triangles_on_[halved], {});
        triangles_on_.erase(halved);
        for (const std::size_t each : meet) split(each, halved, middle);
    }

    void split(std::size_t t, const Edge& halved, std::int32_t middle) {
        std::size_t k = 0;
        while (edge(t, k) != halved) ++k;
        leave(t);
        const auto corners = mesh_.triangles[t];
        const std::int32_t a = corners[k], b = corners[(k + 1) % 3], apex = corners[(k + 2) % 3];
        mesh_.triangles[t] = {a, middle, apex};
        enter(t);
        mesh_.triangles.push_back({middle, b, apex});
        mesh_.patch_of.push_back(mesh_.patch_of[t]);
        enter(mesh_.triangles.size() - 1);
    }

    void enter(std::size_t t) {
        for (std::size_t k = 0; k < 3; ++k) triangles_on_[edge(t, k)].push_back(t);
    }
    void leave(std::size_t t) {
        for (std::size_t k = 0; k < 3; ++k)
            if (const auto found = triangles_on_.find(edge(t, k)); found != triangles_on_.end())
                std::erase(found->second, t);
    }

    Mesh mesh_;
    std::span<const OutlineCorner> corners_;
    std::map<Edge, std::vector<std::size_t>> triangles_on_;
};

void sortByPatch(const Mesh& mesh) {
    std::vector<std::size_t> order(mesh.triangles.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t t) { return mesh.patch_of[t]; });
    const auto triangles = mesh.triangles;
    const auto patch_of = mesh.patch_of;
    for (std::size_t t = 0; t < order.size(); ++t) {
        mesh.triangles[t] = triangles[order[t]];
        mesh.patch_of[t] = patch_of[order[t]];
    }
}

}  // namespace

void grade(const Mesh& mesh, std::span<const OutlineCorner> corners) {
    if (corners.empty()) return;
    Grading(mesh, corners).make();
    sortByPatch(mesh);
}

}  // namespace talus::flow
