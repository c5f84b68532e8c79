// Sets of planes: spherical k-means of axes.

#include <algorithm>
#include <cmath>
#include <numeric>

#include "talus/kinematics.h"
#include "talus/pole_statistics.h"

namespace talus::kinematics {

namespace {

/// Planes within this angle count for how densely planes lie about one: cos 20 degrees, as wide as scattered
/// sets are.
constexpr double kNearCosine = 0.93969262078590838;
constexpr int kMostRounds = 200;

using Normals = std::vector<Vec3>;
using Weights = std::vector<double>;

/// Falls from 1 on the plane to 0 at the angle above.
Weights densities(const Normals& normals, const Weights& weights) {
    Weights density(normals.size(), 0);
    for (std::size_t i = 0; i < normals.size(); ++i) {
        for (std::size_t j = 0; j < normals.size(); ++j)
            density[i] += weights[j] * std::max(0.0, std::abs(normals[i].dot(normals[j])) - kNearCosine);
    }
    return density;
}

Normals firstCentres(const Normals& normals, const Weights& weights, std::size_t count) {
    const Weights density = densities(normals, weights);
    Weights farness(normals.size(), 1);  // least sin^2 of the angle from the centres so far
    Normals centres;
    while (centres.size() < count) {
        std::size_t best = 0;
        for (std::size_t i = 1; i < normals.size(); ++i)
            if (farness[i] * density[i] > farness[best] * density[best]) best = i;
        centres.push_back(normals[best]);
        for (std::size_t i = 0; i < normals.size(); ++i)
            farness[i] = std::min(farness[i], normals[i].cross(centres.back()).squaredNorm());
    }
    return centres;
}

std::size_t nearest(const Vec3& normal, const Normals& centres) {
    std::size_t best = 0;
    for (std::size_t c = 1; c < centres.size(); ++c)
        if (std::abs(normal.dot(centres[c])) > std::abs(normal.dot(centres[best]))) best = c;
    return best;
}

std::vector<std::size_t> assigned(const Normals& normals, const Normals& centres) {
    std::vector<std::size_t> set;
    set.reserve(normals.size());
    for (const Vec3& normal : normals) set.push_back(nearest(normal, centres));
    return set;
}

/// The mean axis of each set; a set that has lost all its planes begins anew at the plane farthest from its
/// own centre.
void moveCentres(const Normals& normals, const Weights& weights, const std::vector<std::size_t>& set,
                 Normals& centres) {
    const Normals before = centres;
    for (std::size_t c = 0; c < centres.size(); ++c) {
        Normals own;
        Weights own_weights;
        for (std::size_t i = 0; i < normals.size(); ++i)
            if (set[i] == c) own.push_back(normals[i]), own_weights.push_back(weights[i]);
        if (!own.empty()) {
            centres[c] = fisherStatistics(own, own_weights).mean;
            continue;
        }
        std::size_t farthest = 0;
        const auto cosine = [&](std::size_t i) { return std::abs(normals[i].dot(before[set[i]])); };
        for (std::size_t i = 1; i < normals.size(); ++i)
            if (cosine(i) < cosine(farthest)) farthest = i;
        centres[c] = normals[farthest];
    }
}

/// Numbers the sets by their number of planes, most first; ties by their first plane.
void order(std::vector<std::size_t>& set, std::size_t count) {
    std::vector<std::size_t> planes(count, 0), first(count, set.size()), by_size(count), rank(count);
    for (std::size_t i = 0; i < set.size(); ++i) {
        ++planes[set[i]];
        first[set[i]] = std::min(first[set[i]], i);
    }
    std::iota(by_size.begin(), by_size.end(), 0);
    std::sort(by_size.begin(), by_size.end(), [&](std::size_t a, std::size_t b) {
        return planes[a] != planes[b] ? planes[a] > planes[b] : first[a] < first[b];
    });
    for (std::size_t r = 0; r < count; ++r) rank[by_size[r]] = r;
    for (std::size_t& each : set) each = rank[each];
}

/// Different planes, counted up to `wanted`.
std::size_t differentPlanes(const Normals& normals, std::size_t wanted) {
    Normals different;
    for (const Vec3& normal : normals) {
        const bool is_new = std::none_of(different.begin(), different.end(), [&](const Vec3& other) {
            return normal.cross(other).norm() < kParallel;
        });
        if (is_new) different.push_back(normal);
        if (different.size() >= wanted) break;
    }
    return different.size();
}

}  // namespace

Result<std::vector<std::size_t>> findSets(const Normals& normals, std::size_t count, const Weights& weights) {
    const std::size_t different = differentPlanes(normals, std::max<std::size_t>(1, count));
    if (count < 1 || count > different) {
        return Error{"sets", "found " + std::to_string(count) + ", allowed: 1 to " +
                                 std::to_string(count < 1 ? normals.size() : different) +
                                 ", the number of different planes"};
    }
    Weights each = weights;
    each.resize(normals.size(), 1);
    Normals centres = firstCentres(normals, each, count);
    std::vector<std::size_t> set = assigned(normals, centres);
    for (int round = 0; round < kMostRounds; ++round) {
        moveCentres(normals, each, set, centres);
        std::vector<std::size_t> next = assigned(normals, centres);
        if (next == set) break;
        set = std::move(next);
    }
    order(set, count);
    return set;
}

}  // namespace talus::kinematics
