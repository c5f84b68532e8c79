// Discs drawn at random.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "geometry/box_tree.h"
#include "rock_mass/place_text.h"
#include "rock_mass/radius_law.h"
#include "rock_mass/random.h"
#include "rock_mass/surface_faults.h"
#include "talus/fractures.h"
#include "talus/rock_mass.h"

namespace talus {

namespace {

using namespace rock_mass;

constexpr std::size_t kMostFractures = 1'000'000;
// Tries per disc that lies in the region, and the first ones: a region that needs more fills almost none of
// its box.
constexpr std::size_t kMostTries = 1000, kFirstTries = 100'000;
constexpr int kMostMisses = 20'000;  // discs drawn again, one after the other
constexpr double kReached = 0.01;    // of the target
constexpr double kPi = std::numbers::pi;

std::vector<Error> numberErrors(const FractureSet& set) {
    std::vector<Error> errors;
    const auto want = [&](bool good, const char* key, const std::string& found, const char* allowed) {
        if (!good) errors.push_back({set.field + key, "found " + found + ", allowed: " + allowed});
    };
    const bool power = set.law == RadiusLaw::power;
    want(power || (set.radius > 0 && std::isfinite(set.radius)), ".radius", numberText(set.radius),
         "greater than 0");
    want(set.law != RadiusLaw::lognormal || set.deviation > 0, ".radius_deviation", numberText(set.deviation),
         "greater than 0");
    want(set.least >= 0 && set.least < set.most && (!power || set.least > 0), ".radius_min",
         numberText(set.least) + " to " + numberText(set.most),
         "the smaller one first, and greater than 0 for a power law");
    want(!power || std::isfinite(set.exponent), ".radius_exponent", numberText(set.exponent),
         "a finite number");
    want(
        set.law != RadiusLaw::lognormal || !(set.radius > 0 && set.deviation > 0) || radiusMoment(set, 0) > 0,
        ".radius_min", numberText(set.least) + " to " + numberText(set.most),
        "a range that contains radii of the law");
    want(!set.fisher || *set.fisher > 0, ".fisher", numberText(set.fisher.value_or(0)), "greater than 0");
    want(!set.p32 || *set.p32 > 0, ".p32", numberText(set.p32.value_or(0)), "greater than 0");
    want(set.p32 || (set.count > 0 && set.count <= kMostFractures), ".count", std::to_string(set.count),
         "1 to 1000000");
    return errors;
}

class Drawing {
 public:
    Drawing(const FractureSet& set, const TriangleSurface& region, std::uint64_t seed, std::size_t index,
            const std::atomic<bool>* stop)
        : set_(set), region_(region), random_(seed, kFractureStream + index, 0), stop_(stop) {
        for (const Vec3& v : region.vertices) box_.add(v);
        mean_ = upwardNormal(set.dip, set.dip_direction);
    }

    Result<std::vector<Fracture>> run() {
        if (auto errors = numberErrors(set_); !errors.empty()) return errors;
        return set_.p32 ? toIntensity() : toCount();
    }

 private:
    static constexpr std::uint64_t kFractureStream = 0x66726163ULL;  // apart from those of joint sets

    Result<std::vector<Fracture>> toCount() {
        std::vector<Fracture> discs;
        for (std::size_t tries = 0; discs.size() < set_.count; ++tries) {
            if (stopped()) return interrupted();
            if (isHopeless(tries, discs.size()))
                return Error{set_.field, "found a region too thin to draw centres in"};
            const Fracture disc = drawnOf(drawnRadius(set_, 0, random_.uniform()), 0);
            if (isInside(disc.centre)) discs.push_back(disc);
        }
        return discs;
    }

    Result<std::vector<Fracture>> toIntensity() {
        const double wanted = *set_.p32 * surfaceVolume(region_);
        const Places places = fewestPlaces();
        if (!(expectedDiscs(places) <= kMostFractures)) return tooMany();
        std::vector<Fracture> discs;
        double area = 0;
        int misses = 0;
        for (std::size_t tries = 0; area < (1 - kReached) * wanted; ++tries) {
            if (stopped()) return interrupted();
            if (isHopeless(tries, discs.size()))
                return Error{set_.field, "found a region too thin for discs to meet it"};
            const Fracture disc = drawNear(places);
            const double more = areaInside(disc, region_);
            if (more > 0 && area + more <= (1 + kReached) * wanted) {
                area += more;
                discs.push_back(disc);
                misses = 0;
            } else if (more > 0 && ++misses > kMostMisses) {
                return Error{set_.field + ".p32",
                             "found " + numberText(*set_.p32) + ", but discs of this size reach " +
                                 numberText(area / surfaceVolume(region_)) +
                                 " and the next one exceeds it by far, allowed: smaller discs, or a count"};
            }
            if (discs.size() > kMostFractures) return tooMany();
        }
        return discs;
    }

    Error tooMany() const {
        return {set_.field + ".p32",
                "found " + numberText(*set_.p32) +
                    ", which requires more than a million discs, allowed: a smaller value, or larger discs"};
    }

    bool stopped() const { return stop_ != nullptr && stop_->load(std::memory_order_relaxed); }
    Error interrupted() const { return {set_.field, "interrupted while discs were drawn"}; }

    static bool isHopeless(std::size_t tries, std::size_t found) {
        return tries > kFirstTries + kMostTries * found;
    }

    /// Volumes of the centres of discs that may reach into the region [m^3]: cumulative, for radii drawn by
    /// the law times r^k.
    struct Places {
        std::array<double, 4> up_to_power{};
        bool slab = false;  // about the sphere around the region, or else about its box
    };

    Places placesOf(std::array<double, 4> volume, bool slab) const {
        for (std::size_t k = 0; k < volume.size(); ++k)
            volume[k] = volume[k] * radiusMoment(set_, static_cast<int>(k)) + (k > 0 ? volume[k - 1] : 0);
        return {volume, slab};
    }

    /// A disc of radius r that meets the box has its centre within r of it: (a + 2r)(b + 2r)(c + 2r). One that
    /// meets the sphere of radius R has its plane within R of the sphere's centre, and its own centre within
    /// r + R of there in the plane: 2 pi R (r + R)^2. Discs drawn about the box rarely reach a region much
    /// smaller than themselves; those about the sphere rarely reach a long region much larger than themselves.
    Places fewestPlaces() const {
        const Vec3 side = box_.max - box_.min;
        const double faces = side.x() * side.y() + side.y() * side.z() + side.z() * side.x();
        const double around = 0.5 * side.norm();
        const Places box = placesOf({side.prod(), 2 * faces, 4 * side.sum(), 8}, false);
        const Places slab =
            placesOf({2 * kPi * std::pow(around, 3), 4 * kPi * around * around, 2 * kPi * around, 0}, true);
        return slab.up_to_power.back() < box.up_to_power.back() ? slab : box;
    }

    /// Number for the target intensity: n discs per volume have an area of n pi E[r^2] in it.
    double expectedDiscs(const Places& places) const {
        return *set_.p32 / (kPi * radiusMoment(set_, 2)) * places.up_to_power.back();
    }

    Fracture drawNear(const Places& places) {
        const double chosen = random_.uniform() * places.up_to_power.back();
        int power = 0;
        while (power < 3 && chosen >= places.up_to_power[static_cast<std::size_t>(power)]) ++power;
        const double radius = drawnRadius(set_, power, random_.uniform());
        return places.slab ? drawnAbout(radius) : drawnOf(radius, radius);
    }

    /// With its centre no farther from the box than a margin, along each axis [m].
    Fracture drawnOf(double radius, double margin) {
        Fracture disc;
        for (int axis = 0; axis < 3; ++axis)
            disc.centre[axis] =
                box_.min[axis] - margin + random_.uniform() * (box_.max[axis] - box_.min[axis] + 2 * margin);
        disc.radius = radius;
        turn(disc);
        return disc;
    }

    /// With its plane through the sphere around the region.
    Fracture drawnAbout(double radius) {
        Fracture disc;
        disc.radius = radius;
        const double around = 0.5 * (box_.max - box_.min).norm();
        const Vec3 normal = turn(disc), strike = normal.unitOrthogonal(), dip = normal.cross(strike);
        const double distance = (radius + around) * std::sqrt(random_.uniform());
        const double angle = 2 * kPi * random_.uniform();
        disc.centre = 0.5 * (box_.min + box_.max) + around * (2 * random_.uniform() - 1) * normal +
                      distance * (std::cos(angle) * strike + std::sin(angle) * dip);
        return disc;
    }

    /// Gives it the set's orientation; returns its normal.
    Vec3 turn(Fracture& disc) {
        disc.dip = set_.dip;
        disc.dip_direction = set_.dip_direction;
        if (!set_.fisher) return mean_;
        const Vec3 normal = scattered(mean_, *set_.fisher, random_);
        std::tie(disc.dip, disc.dip_direction) = dipOf(normal);
        return normal;
    }

    /// By the triangles above it; a point above an edge or a vertex is drawn with probability 0.
    bool isInside(const Vec3& point) const {
        bool inside = false;
        for (std::size_t t = 0; t < region_.triangles.size(); ++t) {
            std::array<double, 3> turn;
            for (std::size_t i = 0; i < 3; ++i) {
                const Vec3 &a = cornerOf(region_, t, i), &b = cornerOf(region_, t, (i + 1) % 3);
                turn[i] = (b.x() - a.x()) * (point.y() - a.y()) - (b.y() - a.y()) * (point.x() - a.x());
            }
            if ((turn[0] > 0) != (turn[1] > 0) || (turn[1] > 0) != (turn[2] > 0)) continue;
            const Vec3 normal = areaVector(region_, t);
            inside ^= normal.dot(cornerOf(region_, t, 0) - point) * normal.z() > 0;
        }
        return inside;
    }

    const FractureSet& set_;
    const TriangleSurface& region_;
    Random random_;
    const std::atomic<bool>* stop_;
    Box box_;
    Vec3 mean_;
};

}  // namespace

Result<std::vector<Fracture>> drawFractures(const FractureSet& set, const TriangleSurface& region,
                                            std::uint64_t seed, std::size_t index,
                                            const std::atomic<bool>* stop) {
    return Drawing(set, region, seed, index, stop).run();
}

}  // namespace talus
