#include "block_theory/directions.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "block_theory/tolerances.h"

namespace talus::keyblocks {
namespace {

/// Directions nearer to each other than this are one: a tenth of the angle at which a neighbour obstructs.
constexpr double kCell = 0.1 * kInTheWay;

/// Unit vectors with weights, those that are equal but for rounding as one.
class Pool {
 public:
    struct Entry {
        Vec3 vector;
        double weight = 0;
    };

    void add(const Vec3& vector, double weight) {
        const auto [at, is_new] = index_.try_emplace(keyOf(vector), entries_.size());
        if (is_new) entries_.push_back({vector, 0});
        entries_[at->second].weight += weight;
    }
    bool has(const Vec3& vector) const { return index_.contains(keyOf(vector)); }

    /// Heaviest first; of equal weights in the order they came.
    std::vector<Entry> sorted() const {
        std::vector<Entry> all = entries_;
        std::stable_sort(all.begin(), all.end(),
                         [](const Entry& a, const Entry& b) { return a.weight > b.weight; });
        return all;
    }

 private:
    static std::uint64_t keyOf(const Vec3& vector) {
        std::uint64_t key = 0;
        for (int axis = 0; axis < 3; ++axis) {
            constexpr std::int64_t kOffset = 1 << 20;  // 2 / kCell cells a side fit into 21 bits
            const auto cell = static_cast<std::int64_t>(std::llround(vector[axis] / kCell));
            key = key << 21U | static_cast<std::uint64_t>(cell + kOffset);
        }
        return key;
    }

    std::vector<Entry> entries_;
    std::unordered_map<std::uint64_t, std::size_t> index_;
};

/// One of a plane's two normals.
Vec3 oriented(const Vec3& normal) {
    for (const int axis : {2, 1, 0})
        if (std::abs(normal[axis]) > kInTheWay) return normal[axis] > 0 ? normal : Vec3(-normal);
    return normal;
}

/// The planes that stand for the slope's sets, that with the most area first.
std::vector<Vec3> setsOf(const Slope& slope) {
    Pool planes;
    for (std::size_t b = 0; b < slope.size(); ++b)
        if (slope.free[b])
            for (const Contact& contact : slope.contactsOf(b))
                planes.add(oriented(contact.normal), contact.area);
    std::vector<Vec3> sets;
    const double least = std::cos(kSameSet);
    for (const Pool::Entry& plane : planes.sorted()) {
        if (sets.size() == kMostSets) break;
        const bool is_new = std::all_of(sets.begin(), sets.end(), [&](const Vec3& set) {
            return std::abs(set.dot(plane.vector)) < least;
        });
        if (is_new) sets.push_back(plane.vector);
    }
    return sets;
}

template <class Add>
void addUnit(const Vec3& vector, double scale, const Add& add) {
    if (const double length = vector.norm(); length > kNoForce * scale) add(Vec3(vector / length));
}

/// Where a force drives along a plane: its dip direction, under weight.
template <class Add>
void addDip(const Vec3& force, const Vec3& normal, const Add& add) {
    addUnit(force - force.dot(normal) * normal, force.norm(), add);
}

/// The line of intersection of two planes, on the force's side.
template <class Add>
void addLine(const Vec3& force, const Vec3& n1, const Vec3& n2, const Add& add) {
    const Vec3 line = n1.cross(n2);
    if (line.norm() < kInTheWay) return;
    const double along = force.dot(line.normalized());
    if (std::abs(along) > kNoForce * force.norm())
        add(Vec3(along > 0 ? line.normalized() : -line.normalized()));
}

/// Whether a force presses on both planes, resolved along their line of intersection and across.
bool pressesBoth(const Vec3& force, const Vec3& n1, const Vec3& n2) {
    const double cosine = n1.dot(n2), f1 = force.dot(n1), f2 = force.dot(n2);
    return cosine * f2 - f1 > 0 && cosine * f1 - f2 > 0;
}

/// The normals of a block's contacts, each once.
void distinctNormals(std::span<const Contact> contacts, std::vector<Vec3>& normals) {
    normals.clear();
    for (const Contact& contact : contacts) {
        const bool known = std::any_of(normals.begin(), normals.end(), [&](const Vec3& n) {
            return (n - contact.normal).norm() <= kInTheWay;
        });
        if (!known) normals.push_back(contact.normal);
    }
}

/// Directions in which a block may move under a force: falling, on a pressed plane, along lines of two
/// planes.
template <class Add>
void addDirectionsUnder(const Vec3& force, const std::vector<Vec3>& normals, const Add& add) {
    addUnit(force, 0, add);
    for (std::size_t i = 0; i < normals.size(); ++i) {
        if (force.dot(normals[i]) < 0) addDip(force, normals[i], add);
        for (std::size_t j = 0; j < i; ++j)
            if (pressesBoth(force, normals[i], normals[j])) addLine(force, normals[i], normals[j], add);
    }
}

/// Under the body force, common to all blocks, and under its own resultant.
template <class Add>
void addDirectionsOf(const Slope& slope, std::size_t block, std::vector<Vec3>& normals, const Add& add) {
    distinctNormals(slope.contactsOf(block), normals);
    addDirectionsUnder(slope.acceleration, normals, add);
    const Vec3 &force = slope.force[block], weight = slope.mass[block] * slope.acceleration;
    if ((force - weight).norm() > kNoForce * force.norm()) addDirectionsUnder(force, normals, add);
}

}  // namespace

Directions directionsOf(const Slope& slope) {
    Directions directions;
    Pool taken;
    const auto take = [&](const Vec3& direction) {
        if (taken.has(direction)) return;
        taken.add(direction, 1);
        directions.everywhere.push_back(direction);
    };
    addUnit(slope.acceleration, 0, take);
    const std::vector<Vec3> sets = setsOf(slope);
    for (std::size_t i = 0; i < sets.size(); ++i) {
        addDip(slope.acceleration, sets[i], take);
        for (std::size_t j = 0; j < i; ++j) addLine(slope.acceleration, sets[i], sets[j], take);
    }
    Pool own;
    std::vector<Vec3> normals;
    for (std::size_t b = 0; b < slope.size(); ++b)
        if (slope.free[b])
            addDirectionsOf(slope, b, normals, [&](const Vec3& s) { own.add(s, slope.mass[b]); });
    for (const Pool::Entry& entry : own.sorted())
        if (directions.everywhere.size() < kMostDirections) take(entry.vector);
    for (std::size_t b = 0; b < slope.size(); ++b)
        if (slope.free[b])
            addDirectionsOf(slope, b, normals, [&](const Vec3& s) {
                if (!taken.has(s)) directions.own.push_back({b, s});
            });
    return directions;
}

}  // namespace talus::keyblocks
