// Discs drawn at random.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rock_mass/box_tree.h"
#include "rock_mass/place_text.h"
#include "rock_mass/random.h"
#include "rock_mass/surface_faults.h"
#include "talus/fractures.h"
#include "talus/rock_mass.h"

namespace talus {

namespace {

using namespace rock_mass;

constexpr std::size_t kMostFractures = 1'000'000;
constexpr std::size_t kMostTries =
    100 * kMostFractures;            // for centres inside a region that fills little of its box
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
         "the lesser first, of a power law greater than 0");
    want(!power || std::isfinite(set.exponent), ".radius_exponent", numberText(set.exponent),
         "a finite number");
    want(!set.fisher || *set.fisher > 0, ".fisher", numberText(set.fisher.value_or(0)), "greater than 0");
    want(!set.p32 || *set.p32 > 0, ".p32", numberText(set.p32.value_or(0)), "greater than 0");
    want(set.p32 || (set.count > 0 && set.count <= kMostFractures), ".count", std::to_string(set.count),
         "1 to 1000000");
    return errors;
}

class Drawing {
 public:
    Drawing(const FractureSet& set, const TriangleSurface& region, std::uint64_t seed, std::size_t index)
        : set_(set), region_(region), random_(seed, kStream + index, 0) {
        for (const Vec3& v : region.vertices) box_.add(v);
        mean_ = upwardNormal(set.dip, set.dip_direction);
    }

    Result<std::vector<Fracture>> run() {
        if (auto errors = numberErrors(set_); !errors.empty()) return errors;
        return set_.p32 ? toIntensity() : toCount();
    }

 private:
    static constexpr std::uint64_t kStream = 0x66726163ULL;  // apart from those of joint sets

    Result<std::vector<Fracture>> toCount() {
        std::vector<Fracture> discs;
        for (std::size_t tries = 0; discs.size() < set_.count; ++tries) {
            if (tries > kMostTries) return Error{set_.field, "found a region too thin to draw centres in"};
            Fracture disc = draw(0);
            if (isInside(disc.centre)) discs.push_back(disc);
        }
        return discs;
    }

    Result<std::vector<Fracture>> toIntensity() {
        const double wanted = *set_.p32 * surfaceVolume(region_), margin = reach();
        std::vector<Fracture> discs;
        double area = 0;
        for (int misses = 0; area < (1 - kReached) * wanted;) {
            const Fracture disc = draw(margin);
            const double more = areaInside(disc, region_);
            if (more > 0 && area + more <= (1 + kReached) * wanted) {
                area += more;
                discs.push_back(disc);
                misses = 0;
            } else if (more > 0 && ++misses > kMostMisses) {
                return Error{set_.field + ".p32",
                             "found " + numberText(*set_.p32) + ", but discs so large reach " +
                                 numberText(area / surfaceVolume(region_)) +
                                 " and then far more, allowed: smaller discs, or a count"};
            }
            if (discs.size() > kMostFractures)
                return Error{set_.field + ".p32",
                             "found " + numberText(*set_.p32) +
                                 ", which takes more than a million discs, allowed: fewer, "
                                 "or larger ones"};
        }
        return discs;
    }

    /// How far from its centre a disc may reach: all but one of ten thousand of a law without end [m].
    double reach() const {
        if (set_.law == RadiusLaw::constant) return set_.radius;
        if (set_.law == RadiusLaw::power) return set_.most;
        const auto [mu, sigma] = logMoments();
        return std::min(set_.most, std::exp(mu + 3.72 * sigma));
    }

    /// Mean and deviation of the logarithm of a lognormal radius.
    std::pair<double, double> logMoments() const {
        const double ratio = set_.deviation / set_.radius, variance = std::log1p(ratio * ratio);
        return {std::log(set_.radius) - 0.5 * variance, std::sqrt(variance)};
    }

    double drawRadius() {
        if (set_.law == RadiusLaw::constant) return set_.radius;
        if (set_.law == RadiusLaw::power) {
            const double u = random_.uniform(), k = 1 - set_.exponent;
            if (std::abs(k) < 1e-12) return set_.least * std::pow(set_.most / set_.least, u);
            const double low = std::pow(set_.least, k), high = std::pow(set_.most, k);
            return std::pow(low + u * (high - low), 1 / k);
        }
        const auto [mu, sigma] = logMoments();
        double radius = 0;
        for (int tries = 0; tries < 10'000; ++tries) {  // Box and Muller (1958)
            const double u = 1 - random_.uniform(), turn = 2 * kPi * random_.uniform();
            radius = std::exp(mu + sigma * std::sqrt(-2 * std::log(u)) * std::cos(turn));
            if (radius >= set_.least && radius <= set_.most) return radius;
        }
        return std::clamp(radius, set_.least, set_.most);
    }

    Fracture draw(double margin) {
        Fracture disc;
        for (int axis = 0; axis < 3; ++axis)
            disc.centre[axis] =
                box_.min[axis] - margin + random_.uniform() * (box_.max[axis] - box_.min[axis] + 2 * margin);
        disc.radius = drawRadius();
        disc.dip = set_.dip;
        disc.dip_direction = set_.dip_direction;
        if (set_.fisher)
            std::tie(disc.dip, disc.dip_direction) = dipOf(scattered(mean_, *set_.fisher, random_));
        return disc;
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
    Box box_;
    Vec3 mean_;
};

}  // namespace

Result<std::vector<Fracture>> drawFractures(const FractureSet& set, const TriangleSurface& region,
                                            std::uint64_t seed, std::size_t index) {
    return Drawing(set, region, seed, index).run();
}

}  // namespace talus
