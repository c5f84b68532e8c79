#include "talus/ending_sets.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rock_mass/joints.h"
#include "rock_mass/random.h"

namespace talus {

namespace {

using namespace rock_mass;

constexpr std::size_t kMostJoints = 1'000'000;  // a mistyped spacing makes more; these take some 0.3 GB
constexpr double kParallelPlanes = 1e-6;        // sine of the angle between the planes
constexpr double kNarrow = 1e-9;                // of the region's size: no rectangle
constexpr std::uint64_t kEndingStream = 0x656e64696e67;  // of random numbers that no other set has

/// A slab between two planes of the other joint; the first and last slab are open on one side [m along its
/// normal].
struct Slab {
    double low = -std::numeric_limits<double>::infinity(), high = -low;
    std::int64_t number = 0;  ///< of the plane at its lower side; of the lowest slab one less than the first
};

class Ending {
 public:
    Ending(const EndingSet& ending, std::size_t index, const RockMass& description)
        : ending_(ending), index_(index), description_(description) {}

    Result<std::vector<SingleJoint>> run() {
        if (auto errors = checkAll(); !errors.empty()) return errors;
        const auto planes = jointPlanes(description_, description_.region.vertices);
        if (!planes) return planes.errors();
        across_ = otherNormal();
        if (across_.cross(upwardNormal(ending_.set.dip, ending_.set.dip_direction)).norm() < kParallelPlanes)
            return fault(".ends_at", "found a joint parallel to this set, allowed: one that meets it");
        bound();
        for (const Slab& slab : slabs(*planes))
            if (auto error = fill(slab)) return *error;
        return std::move(joints_);
    }

 private:
    Error fault(const char* key, std::string message) const {
        return {ending_.set.field + key, std::move(message)};
    }

    bool isSet() const { return ending_.ends_at < description_.sets.size(); }
    const SingleJoint& single() const {
        return description_.singles[ending_.ends_at - description_.sets.size()];
    }

    std::vector<Error> checkAll() const {
        RockMass own;
        own.sets.push_back(ending_.set);
        auto errors = checkJoints(own);
        for (Error& error : checkJoints(description_)) errors.push_back(std::move(error));
        if (isSet() && description_.sets[ending_.ends_at].fisher) {
            errors.push_back(fault(".ends_at",
                                   "found a set of scattered orientation (fisher), allowed: a set of "
                                   "parallel planes, or a single plane"));
        }
        if (!isSet() && (single().radius || !single().polygon.empty())) {
            errors.push_back(fault(".ends_at",
                                   "found a finite joint, allowed: a joint set, or a single joint without "
                                   "radius and polygon"));
        }
        return errors;
    }

    Vec3 otherNormal() const {
        if (!isSet()) return upwardNormal(single().dip, single().dip_direction);
        const JointSet& set = description_.sets[ending_.ends_at];
        return upwardNormal(set.dip, set.dip_direction);
    }

    void bound() {
        Vec3 low = description_.region.vertices[0], high = low;
        for (const Vec3& v : description_.region.vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
        middle_ = 0.5 * (low + high);
        reach_ = (high - low).norm();
    }

    std::vector<Slab> slabs(const std::vector<JointPlane>& planes) const {
        std::vector<std::pair<double, std::int64_t>> places;
        for (const JointPlane& plane : planes)
            if (plane.joint == ending_.ends_at) places.emplace_back(plane.plane.offset, plane.plane.number);
        std::sort(places.begin(), places.end());
        std::vector<Slab> all(1);
        all[0].number = places.empty() ? 0 : places[0].second - 1;
        for (const auto& [place, number] : places) {
            all.back().high = place;
            all.emplace_back();
            all.back().low = place;
            all.back().number = number;
        }
        return all;
    }

    std::optional<Error> fill(const Slab& slab) {
        Random random(description_.seed ^ kEndingStream, index_, slab.number);
        RockMass own;
        own.seed = random.next();
        own.sets.push_back(ending_.set);
        own.sets[0].origin = middle_;
        own.sets[0].offset = random.uniform() * ending_.set.spacing;
        const auto planes = jointPlanes(own, description_.region.vertices);
        if (!planes) return planes.errors()[0];
        for (const JointPlane& plane : *planes) {
            add(plane.plane, slab);
            if (joints_.size() > kMostJoints) {
                return fault(".spacing", "found more than " + std::to_string(kMostJoints) +
                                             " joints between the planes of the other, allowed: wider "
                                             "spacings");
            }
        }
        return std::nullopt;
    }

    /// The rectangle of a plane between the two sides of a slab, if it comes near the region.
    void add(const Plane& plane, const Slab& slab) {
        const Vec3 along = across_.cross(plane.normal);
        if (along.norm() < kParallelPlanes) return;  // a scattered one that follows the other joint
        const Vec3 strike = along.normalized(), up = plane.normal.cross(strike);
        const Vec3 centre = middle_ - plane.height(middle_) * plane.normal;
        // Up the plane, the distance from the other joint changes linearly.
        const double slope = across_.dot(up), at = across_.dot(centre);
        const double a = (slab.low - at) / slope, b = (slab.high - at) / slope;
        const double low = std::max(std::min(a, b), -reach_), high = std::min(std::max(a, b), reach_);
        if (!(high - low > kNarrow * reach_) || !meets(plane)) return;
        SingleJoint joint;
        joint.name = ending_.set.name;
        joint.joint = ending_.set.joint;
        joint.field = ending_.set.field;
        joint.of_network = true;
        for (const auto& [e, u] : {std::pair(-reach_, low), std::pair(reach_, low), std::pair(reach_, high),
                                   std::pair(-reach_, high)})
            joint.polygon.push_back(centre + e * strike + u * up);
        joints_.push_back(std::move(joint));
    }

    bool meets(const Plane& plane) const {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const Vec3& corner : description_.region.vertices) {
            low = std::min(low, plane.height(corner));
            high = std::max(high, plane.height(corner));
        }
        return low < 0 && high > 0;
    }

    const EndingSet& ending_;
    std::size_t index_;
    const RockMass& description_;
    Vec3 across_ = Vec3::UnitZ();  ///< normal of the other joint
    Vec3 middle_ = Vec3::Zero();   ///< of the region's box [m]
    double reach_ = 0;             ///< farther than any point of the region from there [m]
    std::vector<SingleJoint> joints_;
};

}  // namespace

Result<std::vector<SingleJoint>> endingJoints(const EndingSet& ending, std::size_t index,
                                              const RockMass& description) {
    return Ending(ending, index, description).run();
}

}  // namespace talus
