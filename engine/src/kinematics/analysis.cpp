// All planes and all pairs of planes through the tests, counted by set.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "talus/angles.h"
#include "talus/kinematics.h"
#include "talus/rock_mass.h"

namespace talus::kinematics {

namespace {

constexpr double kRightAngle = std::numbers::pi / 2;

std::string degreesText(double angle) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.6g", degrees(angle));
    return buffer;
}

bool within(double value, double low, double high) { return value >= low && value <= high; }

std::optional<Error> faultOf(const Face& face, const Limits& limits) {
    if (!(face.dip > kSameAngle && face.dip <= kRightAngle + kSameAngle)) {
        return Error{"slope", "found a dip of " + degreesText(face.dip) +
                                  ", allowed: greater than 0 and at most 90 degrees"};
    }
    if (!std::isfinite(face.dip_direction))
        return Error{"slope", "found a dip direction that is not a number, allowed: degrees from north"};
    if (!within(limits.friction, 0, kRightAngle + kSameAngle))
        return Error{"friction", "found " + degreesText(limits.friction) + ", allowed: 0 to 90 degrees"};
    if (!within(limits.lateral, 0, kRightAngle + kSameAngle))
        return Error{"lateral", "found " + degreesText(limits.lateral) + ", allowed: 0 to 90 degrees"};
    return std::nullopt;
}

std::optional<Error> faultOf(const std::vector<Pole>& poles, std::size_t sets) {
    if (poles.empty() || poles.size() > kMostPoles) {
        return Error{"poles", "found " + std::to_string(poles.size()) + ", allowed: 1 to " +
                                  std::to_string(kMostPoles)};
    }
    for (std::size_t p = 0; p < poles.size(); ++p) {
        const std::string field = "poles[" + std::to_string(p) + "]";
        if (poles[p].set >= sets) {
            return Error{field, "found set " + std::to_string(poles[p].set) + ", allowed: less than " +
                                    std::to_string(sets)};
        }
        if (!(poles[p].weight > 0 && std::isfinite(poles[p].weight)))
            return Error{field, "found a weight that is not positive, allowed: greater than 0"};
        if (!(std::abs(poles[p].normal.norm() - 1) < kSameAngle && poles[p].normal.z() >= -kSameAngle))
            return Error{field, "found a normal that is not an upward unit vector, allowed: one that is"};
    }
    return std::nullopt;
}

PlaneShares testPlane(const Pole& pole, const Face& face, const Limits& limits) {
    PlaneShares shares;
    const bool base = topplingZone(-pole.normal, face, limits) != TopplingZone::none;
    shares.planar.count(planarSliding(pole.normal, face, limits), pole.weight);
    shares.planar_without_limits.count(planarSliding(pole.normal, face, {limits.friction, std::numbers::pi}),
                                       pole.weight);
    shares.flexural.count(flexuralToppling(pole.normal, face, limits), pole.weight);
    shares.base.count(base, pole.weight);
    shares.sliding_base = base && dipOfPlane(pole.normal) > limits.friction + kSameAngle ? 1 : 0;
    return shares;
}

/// A cheap necessary condition of a critical line: most pairs need no angles.
struct Prefilter {
    Vec3 face_normal, into_face;
    double least_sine;  ///< of the plunge of lines that topple

    explicit Prefilter(const Face& face)
        : face_normal(upwardNormal(face.dip, face.dip_direction)),
          into_face(-std::sin(face.dip_direction), -std::cos(face.dip_direction), 0),
          least_sine(std::cos(face.dip) - kSameAngle) {}

    bool maySlide(const Vec3& line) const { return line.dot(face_normal) > 0; }
    bool mayTopple(const Vec3& line) const {
        return -line.z() > least_sine && line.dot(into_face) > -kSameAngle;
    }
};

/// Whether the wedge holds by friction alone on what it slides on.
bool isHeld(const Pole& a, const Pole& b, const Vec3& line, SlidesOn on, double friction) {
    const double steepness =
        on == SlidesOn::both ? plungeOf(line) : dipOfPlane(on == SlidesOn::first ? a.normal : b.normal);
    return steepness <= friction + kSameAngle;
}

void testPair(const Pole& a, const Pole& b, const Face& face, const Limits& limits, const Prefilter& may,
              LineShares& shares) {
    const auto line = intersection(a.normal, b.normal);
    if (!line) {
        ++shares.parallel;
        return;
    }
    const double weight = a.weight * b.weight;
    const WedgeZone zone = may.maySlide(*line) ? wedgeZone(*line, face, limits.friction) : WedgeZone::none;
    shares.wedge.count(zone != WedgeZone::none, weight);
    if (zone != WedgeZone::none) {
        ++(zone == WedgeZone::primary ? shares.primary : shares.secondary);
        const SlidesOn on = slidesOn(a.normal, b.normal);
        if (on != SlidesOn::both) ++shares.on_one_plane;
        if (isHeld(a, b, *line, on, limits.friction)) ++shares.held_by_friction;
    }
    const TopplingZone toppling =
        may.mayTopple(*line) ? topplingZone(*line, face, limits) : TopplingZone::none;
    shares.direct.count(toppling == TopplingZone::direct, weight);
    shares.oblique.count(toppling == TopplingZone::oblique, weight);
}

void add(PlaneShares& sum, const PlaneShares& part) {
    sum.planar.add(part.planar);
    sum.planar_without_limits.add(part.planar_without_limits);
    sum.flexural.add(part.flexural);
    sum.base.add(part.base);
    sum.sliding_base += part.sliding_base;
}

void add(LineShares& sum, const LineShares& part) {
    sum.wedge.add(part.wedge);
    sum.primary += part.primary;
    sum.secondary += part.secondary;
    sum.on_one_plane += part.on_one_plane;
    sum.held_by_friction += part.held_by_friction;
    sum.direct.add(part.direct);
    sum.oblique.add(part.oblique);
    sum.parallel += part.parallel;
}

double percentOf(double part, double whole) { return whole > 0 ? 100 * part / whole : 0; }

/// Place of the pair of sets a <= b in (0, 0), (0, 1), ..., (1, 1), ...
std::size_t placeOf(std::size_t a, std::size_t b, std::size_t sets) { return a * sets - a * (a + 1) / 2 + b; }

}  // namespace

double Share::percent() const { return percentOf(static_cast<double>(critical), static_cast<double>(total)); }

double Share::weightedPercent() const { return percentOf(critical_weight, total_weight); }

void Share::count(bool is_critical, double weight) {
    ++total;
    total_weight += weight;
    if (!is_critical) return;
    ++critical;
    critical_weight += weight;
}

void Share::add(const Share& other) {
    critical += other.critical;
    total += other.total;
    critical_weight += other.critical_weight;
    total_weight += other.total_weight;
}

Result<Analysis> analyse(const std::vector<Pole>& poles, std::size_t sets, const Face& face,
                         const Limits& limits) {
    if (auto fault = faultOf(face, limits)) return *fault;
    if (auto fault = faultOf(poles, sets)) return *fault;
    Analysis analysis;
    analysis.sets.resize(sets);
    for (std::size_t a = 0; a < sets; ++a)
        for (std::size_t b = a; b < sets; ++b) analysis.pairs.push_back({a, b, {}});
    for (const Pole& pole : poles) add(analysis.sets[pole.set], testPlane(pole, face, limits));
    const Prefilter may(face);
    for (std::size_t i = 0; i < poles.size(); ++i) {
        for (std::size_t j = i + 1; j < poles.size(); ++j) {
            const auto [a, b] = std::minmax(poles[i].set, poles[j].set);
            testPair(poles[i], poles[j], face, limits, may, analysis.pairs[placeOf(a, b, sets)].lines);
        }
    }
    for (const PlaneShares& set : analysis.sets) add(analysis.planes, set);
    for (const SetPair& pair : analysis.pairs) add(analysis.lines, pair.lines);
    return analysis;
}

}  // namespace talus::kinematics
