#include "rock_mass/expected_blocks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace talus::rock_mass {

namespace {

constexpr std::size_t kScatterDirections = 16;  // that stand for the planes of a joint set with scatter
constexpr double kInFace = 1e-9;                // of the region: a plane this near to its side cuts nothing
constexpr std::size_t kMostFamilies = 200;      // triples of them are looked at one by one

/// Parallel planes.
struct Family {
    Vec3 normal;
    double density = 0;  ///< area per volume [1/m]
};

struct Region {
    Vec3 middle, size;  ///< of its box [m]
    double volume;      ///< [m^3]
};

/// Mean area in the region of a plane that meets it, over all its positions [m^2].
double areaOf(const JointPlane& joint, const Region& region) {
    const double across = joint.plane.normal.cwiseAbs().dot(region.size);
    if (std::abs(joint.plane.height(region.middle)) > (0.5 - kInFace) * across) return 0;
    return region.volume / across;
}

double perimeter(const Polygon& polygon) {
    double length = 0;
    for (std::size_t k = 0; k < polygon.size(); ++k)
        length += (polygon[(k + 1) % polygon.size()] - polygon[k]).norm();
    return length;
}

bool meets(const Reach& reach, const Region& region) {
    const Vec3 half = 0.5 * region.size;
    return (reach.max.array() > (region.middle - half).array()).all() &&
           (reach.min.array() < (region.middle + half).array()).all();
}

/// Mean number of blocks that a finite joint meets, and so cuts from side to side. For randomly placed cubes
/// it is 1 + n (S b' + S' b) / 2 by the kinematic formula, with surfaces S, mean widths b and n cubes per
/// volume.
double blocksMet(const JointPlane& joint, const Region& region, double count) {
    const Reach& reach = *joint.reach;
    const double through = areaOf(joint, region);
    if (through == 0 || !meets(reach, region)) return 0;
    const double own =
        reach.radius > 0 ? std::numbers::pi * reach.radius * reach.radius : area(reach.polygon);
    const double round = reach.radius > 0 ? 2 * std::numbers::pi * reach.radius : perimeter(reach.polygon);
    const double inside = std::min(1.0, through / own);
    const double side = std::cbrt(region.volume / count);
    return 1 + 1.5 * inside * own / (side * side) + 0.75 * std::sqrt(inside) * round / side;
}

/// An evenly spaced sample of a list.
template <class T>
std::vector<T> thinned(const std::vector<T>& all, std::size_t most) {
    if (all.size() <= most) return all;
    std::vector<T> some;
    for (std::size_t k = 0; k < most; ++k) some.push_back(all[k * all.size() / most]);
    return some;
}

/// A set's planes, a single joint, or a sample of directions for many of these.
void appendFamilies(const std::vector<JointPlane>& joints, const std::vector<std::size_t>& members,
                    const Region& region, std::vector<Family>& families) {
    double density = 0;
    for (const std::size_t m : members) density += areaOf(joints[m], region) / region.volume;
    const bool parallel = std::all_of(members.begin(), members.end(), [&](std::size_t m) {
        return joints[m].plane.normal == joints[members[0]].plane.normal;
    });
    const auto some = thinned(members, parallel ? 1 : kScatterDirections);
    for (const std::size_t m : some)
        families.push_back({joints[m].plane.normal, density / static_cast<double>(some.size())});
}

std::vector<Family> familiesOf(const std::vector<JointPlane>& joints, const Region& region) {
    std::map<std::size_t, std::vector<std::size_t>> members;
    for (std::size_t k = 0; k < joints.size(); ++k)
        if (!joints[k].reach) members[joints[k].joint].push_back(k);
    std::vector<Family> families;
    for (const auto& [joint, planes] : members) appendFamilies(joints, planes, region, families);
    if (families.size() <= kMostFamilies) return families;
    std::vector<Family> some = thinned(families, kMostFamilies);
    double all = 0, left = 0;
    for (const Family& family : families) all += family.density;
    for (const Family& family : some) left += family.density;
    for (Family& family : some) family.density *= all / left;
    return some;
}

/// Area of a box's shadow along a direction [m^2].
double shadow(const Vec3& size, const Vec3& along) {
    const Vec3 sides(size.y() * size.z(), size.x() * size.z(), size.x() * size.y());
    return sides.dot(along.cwiseAbs());
}

}  // namespace

double expectedBlocks(const std::vector<JointPlane>& joints, const Vec3& min, const Vec3& max, double volume,
                      double enough) {
    const Region region{0.5 * (min + max), max - min, volume};
    const std::vector<Family> families = familiesOf(joints, region);
    double count = 1;
    for (const JointPlane& joint : joints) count += !joint.reach && areaOf(joint, region) > 0 ? 1.0 : 0.0;
    for (std::size_t i = 0; i < families.size(); ++i)
        for (std::size_t j = 0; j < i && count <= enough; ++j) {
            const Vec3 line = families[i].normal.cross(families[j].normal);
            const double pair = families[i].density * families[j].density;
            count += pair * shadow(region.size, line);  // |line| times the shadow along it
            for (std::size_t k = 0; k < j; ++k)
                count += pair * families[k].density * std::abs(line.dot(families[k].normal)) * volume;
        }
    // Finite joints cut in turn the blocks that exist by then.
    for (std::size_t k = 0; k < joints.size() && count <= enough; ++k)
        if (joints[k].reach) count += blocksMet(joints[k], region, count);
    return count;
}

}  // namespace talus::rock_mass
