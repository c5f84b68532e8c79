// Counts over planes and pairs: a model done by hand, symmetry, and what is refused.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "rock_mass/random.h"
#include "talus/kinematics.h"
#include "talus/rock_mass.h"

using namespace talus;
using namespace talus::kinematics;

namespace {

constexpr double kDeg = std::numbers::pi / 180;

Pole pole(double dip, double dip_direction, std::size_t set = 0, double weight = 1) {
    return {upwardNormal(dip * kDeg, dip_direction * kDeg), weight, set};
}

/// Planes at random, none of them on a limit.
std::vector<Pole> scatteredPoles(std::size_t count, double turn = 0) {
    rock_mass::Random random(11);
    std::vector<Pole> poles;
    for (std::size_t k = 0; k < count; ++k) {
        const double dip = std::acos(random.uniform()) / kDeg, to = 360 * random.uniform();
        poles.push_back(pole(dip, to + turn, k % 3, 0.5 + random.uniform()));
    }
    return poles;
}

/// An oracle in the angles of the field: dips, directions, plunges and trends in degrees, no vectors.
namespace field {

double off(double a, double b) {
    const double d = std::fmod(std::abs(a - b), 360);
    return std::min(d, 360 - d);
}

double apparent(double dip, double to, double trend) {
    return std::atan2(std::sin(dip * kDeg) * std::cos((trend - to) * kDeg), std::cos(dip * kDeg)) / kDeg;
}

struct Plane {
    double dip, to;
};
struct Line {
    double plunge, trend;
};

/// The trend at which both planes have one apparent dip.
Line meet(const Plane& a, const Plane& b) {
    const double ta = std::tan(a.dip * kDeg), tb = std::tan(b.dip * kDeg);
    const double c = ta * std::cos(a.to * kDeg) - tb * std::cos(b.to * kDeg);
    const double s = ta * std::sin(a.to * kDeg) - tb * std::sin(b.to * kDeg);
    const double trend = std::atan2(-c, s) / kDeg, plunge = apparent(a.dip, a.to, trend);
    return plunge < 0 ? Line{-plunge, trend + 180} : Line{plunge, trend};
}

struct Counts {
    std::size_t planar = 0, flexural = 0, base = 0, primary = 0, secondary = 0, one = 0, held = 0, direct = 0,
                oblique = 0;
    bool operator==(const Counts&) const = default;
};

Counts counted(const std::vector<Plane>& planes, const Plane& face, double friction, double lateral) {
    Counts n;
    const auto topples = [&](const Line& line, std::size_t& direct, std::size_t& oblique) {
        const double across = off(line.trend, face.to + 180);
        if (line.plunge <= 90 - face.dip) return;
        if (across <= lateral)
            ++direct;
        else if (across < 90 && line.plunge > 90 - friction)
            ++oblique;
    };
    for (const Plane& p : planes) {
        n.planar +=
            p.dip > friction && p.dip < apparent(face.dip, face.to, p.to) && off(p.to, face.to) <= lateral;
        n.flexural += face.dip > friction && off(p.to + 180, face.to) <= lateral &&
                      90 - p.dip < apparent(face.dip - friction, face.to, p.to + 180);
        topples({90 - p.dip, p.to + 180}, n.base, n.base);
    }
    for (std::size_t i = 0; i < planes.size(); ++i)
        for (std::size_t j = i + 1; j < planes.size(); ++j) {
            const Plane &a = planes[i], &b = planes[j];
            const Line line = meet(a, b);
            topples(line, n.direct, n.oblique);
            if (line.plunge >= apparent(face.dip, face.to, line.trend)) continue;
            const bool primary = line.plunge > friction;
            if (!primary && line.plunge <= apparent(friction, face.to, line.trend)) continue;
            ++(primary ? n.primary : n.secondary);
            const double across = std::cos((a.to - b.to) * kDeg);
            const double ta = std::tan(a.dip * kDeg), tb = std::tan(b.dip * kDeg);
            const bool on_a = tb * across > ta, on_b = ta * across > tb;
            n.one += on_a || on_b;
            n.held += (on_a ? a.dip : on_b ? b.dip : line.plunge) <= friction;
        }
    return n;
}

}  // namespace field

bool same(const Share& a, const Share& b) { return a.critical == b.critical && a.total == b.total; }

}  // namespace

TEST_CASE("two sets and a face, counted by hand") {
    // Face 70/180, friction 30, lateral limits 20. Set 0: 45/180 slides; 50/195 slides (within 20); 25/180 is
    // flatter than friction; 45/210 lies outside the limits. Set 1: 80/000 topples ((90 - 80) + 30 < 70);
    // 75/355 topples; 55/010 topples; 45/000 does not ((90 - 45) + 30 > 70).
    const std::vector<Pole> poles{pole(45, 180, 0), pole(50, 195, 0), pole(25, 180, 0), pole(45, 210, 0),
                                  pole(80, 0, 1),   pole(75, 355, 1), pole(55, 10, 1),  pole(45, 0, 1)};
    const auto analysis = analyse(poles, 2, {70 * kDeg, 180 * kDeg}, {30 * kDeg, 20 * kDeg});
    REQUIRE(analysis);
    CHECK(same(analysis->planes.planar, {2, 8, 0, 0}));
    CHECK(same(analysis->planes.planar_without_limits, {3, 8, 0, 0}));
    CHECK(same(analysis->planes.flexural, {3, 8, 0, 0}));
    CHECK(analysis->planes.planar.percent() == 25);
    CHECK(same(analysis->sets[0].planar, {2, 4, 0, 0}));
    CHECK(same(analysis->sets[1].planar, {0, 4, 0, 0}));
    CHECK(same(analysis->sets[1].flexural, {3, 4, 0, 0}));
    // Base planes dip out of the face by less than 70 within the limits: 45/180, 50/195, 25/180; outside them
    // 45/210 is steeper than friction. Two of them are steeper than friction.
    CHECK(same(analysis->planes.base, {3, 8, 0, 0}));
    CHECK(analysis->planes.sliding_base == 2);
    // 28 pairs. 45/180 with 25/180, with 80/000 and with 45/000 meet along the strike, and so do the pairs of
    // those four: horizontal lines, none critical; no two planes are parallel.
    CHECK(analysis->lines.wedge.total == 28);
    CHECK(analysis->lines.parallel == 0);
    std::size_t total = 0;
    for (const SetPair& pair : analysis->pairs) total += pair.lines.wedge.total;
    CHECK(total == 28);
    CHECK(analysis->pairs[1].lines.wedge.total == 16);
}

TEST_CASE("one wedge by hand: both zones, one plane or both, and what friction holds") {
    const Face face{70 * kDeg, 180 * kDeg};
    const auto pair = [&](const Pole& a, const Pole& b, double friction = 30) {
        return analyse({a, b}, 1, face, {friction * kDeg, 20 * kDeg})->lines;
    };
    // 50/135 and 50/225: the line to 180 plunges atan(tan 50 cos 45) = 40.1.
    LineShares lines = pair(pole(50, 135), pole(50, 225));
    CHECK(lines.primary == 1);
    CHECK(lines.on_one_plane == 0);
    CHECK(pair(pole(50, 135), pole(50, 225), 41).wedge.critical == 0);
    // 45/190 and 80/250: tan 80 cos 60 > tan 45, so the first alone; the line's trend is that at which both
    // have one apparent dip.
    lines = pair(pole(45, 190), pole(80, 250));
    CHECK(lines.wedge.critical == 1);
    CHECK(lines.on_one_plane == 1);
    CHECK(lines.held_by_friction == 0);
    // 40/200 and a vertical plane that strikes 060: the line trends 240, where 40/200 has the apparent dip
    // atan(tan 40 cos 40) = 32.7. That is flatter than a friction of 35, steeper than the friction plane's
    // 19.3 there, and flatter than the face's 53.9. The wedge slides on 40/200, which is steeper than 35 but
    // not than 41.
    lines = pair(pole(40, 200), pole(90, 330), 35);
    CHECK(lines.secondary == 1);
    CHECK(lines.on_one_plane == 1);
    CHECK(lines.held_by_friction == 0);
    lines = pair(pole(40, 200), pole(90, 150), 41);
    CHECK(lines.secondary == 1);
    CHECK(lines.held_by_friction == 1);
    // Two planes that are both flatter than friction meet in the secondary zone and hold.
    lines = pair(pole(29, 250), pole(28, 225));
    CHECK(lines.secondary == 1);
    CHECK(lines.held_by_friction == 1);
}

TEST_CASE("drawn planes and faces: the counts are those of the conditions written in dips and trends") {
    rock_mass::Random random(23);
    for (int trial = 0; trial < 30; ++trial) {
        std::vector<field::Plane> planes;
        std::vector<Pole> poles;
        for (int k = 0; k < 40; ++k) {
            planes.push_back({std::acos(random.uniform()) / kDeg, 360 * random.uniform()});
            poles.push_back(pole(planes.back().dip, planes.back().to));
        }
        const field::Plane face{25 + 65 * random.uniform(), 360 * random.uniform()};
        const double friction = 10 + 50 * random.uniform(), lateral = 10 + 30 * random.uniform();
        const auto found =
            analyse(poles, 1, {face.dip * kDeg, face.to * kDeg}, {friction * kDeg, lateral * kDeg});
        const PlaneShares& p = found->planes;
        const LineShares& l = found->lines;
        const field::Counts counts{p.planar.critical,  p.flexural.critical, p.base.critical,
                                   l.primary,          l.secondary,         l.on_one_plane,
                                   l.held_by_friction, l.direct.critical,   l.oblique.critical};
        CHECK(counts == field::counted(planes, face, friction, lateral));
    }
}

TEST_CASE("parallel planes have no line of intersection") {
    const auto analysis = analyse({pole(45, 180), pole(45, 180), pole(90, 0), pole(90, 180)}, 1,
                                  {70 * kDeg, 180 * kDeg}, {30 * kDeg, 20 * kDeg});
    CHECK(analysis->lines.parallel == 2);
    CHECK(analysis->lines.wedge.total == 4);
}

TEST_CASE("turning the face and the planes together about the vertical leaves all counts") {
    const Limits limits{30 * kDeg, 20 * kDeg};
    for (const double dip : {40.0, 70.0, 90.0}) {
        const auto first = analyse(scatteredPoles(120), 3, {dip * kDeg, 0}, limits);
        CHECK(first->planes.planar.total == 120);
        CHECK(first->lines.wedge.total == 120 * 119 / 2);
        for (const double turn : {33.0, 90.0, 180.0, 271.5}) {
            const auto turned = analyse(scatteredPoles(120, turn), 3, {dip * kDeg, turn * kDeg}, limits);
            CHECK(same(first->planes.planar, turned->planes.planar));
            CHECK(same(first->planes.flexural, turned->planes.flexural));
            CHECK(same(first->planes.base, turned->planes.base));
            CHECK(same(first->lines.wedge, turned->lines.wedge));
            CHECK(first->lines.secondary == turned->lines.secondary);
            CHECK(first->lines.on_one_plane == turned->lines.on_one_plane);
            CHECK(same(first->lines.direct, turned->lines.direct));
            CHECK(same(first->lines.oblique, turned->lines.oblique));
        }
    }
}

TEST_CASE("more friction never makes a plane or a wedge of the primary zone critical") {
    std::size_t planar = 1000, wedges = 100'000, flexural = 1000;
    for (double friction = 0; friction <= 90; friction += 5) {
        const auto found = analyse(scatteredPoles(100), 3, {75 * kDeg, 0}, {friction * kDeg, 20 * kDeg});
        CHECK(found->planes.planar.critical <= planar);
        CHECK(found->planes.flexural.critical <= flexural);
        CHECK(found->lines.primary <= wedges);
        CHECK(found->lines.wedge.critical == found->lines.primary + found->lines.secondary);
        planar = found->planes.planar.critical, flexural = found->planes.flexural.critical;
        wedges = found->lines.primary;
    }
    CHECK(planar == 0);
    CHECK(wedges == 0);
    CHECK(flexural == 0);
}

TEST_CASE("the order of planes does not matter, and weights count by themselves") {
    auto poles = scatteredPoles(60);
    const Face face{75 * kDeg, 0};
    const Limits limits{30 * kDeg, 20 * kDeg};
    const auto first = analyse(poles, 3, face, limits);
    std::reverse(poles.begin(), poles.end());
    const auto reversed = analyse(poles, 3, face, limits);
    CHECK(same(first->lines.wedge, reversed->lines.wedge));
    CHECK(same(first->lines.direct, reversed->lines.direct));
    CHECK(first->lines.on_one_plane == reversed->lines.on_one_plane);
    CHECK(first->lines.wedge.critical_weight ==
          doctest::Approx(reversed->lines.wedge.critical_weight).epsilon(1e-12));
    double sum = 0;
    for (const Pole& pole : poles) sum += pole.weight;
    CHECK(first->planes.planar.total_weight == doctest::Approx(sum).epsilon(1e-14));
}

TEST_CASE("what is out of range is refused") {
    const Face face{70 * kDeg, 0};
    const Limits limits{30 * kDeg, 20 * kDeg};
    const auto field = [](const Result<Analysis>& result) {
        REQUIRE_FALSE(result.ok());
        return result.errors()[0].field;
    };
    const std::vector<Pole> one{pole(45, 0)};
    CHECK(field(analyse(one, 1, {0, 0}, limits)) == "slope");
    CHECK(field(analyse(one, 1, {91 * kDeg, 0}, limits)) == "slope");
    CHECK(field(analyse(one, 1, {45 * kDeg, std::nan("")}, limits)) == "slope");
    CHECK(field(analyse(one, 1, face, {-0.1, 0.1})) == "friction");
    CHECK(field(analyse(one, 1, face, {91 * kDeg, 0.1})) == "friction");
    CHECK(field(analyse(one, 1, face, {0.1, 91 * kDeg})) == "lateral");
    CHECK(field(analyse({}, 1, face, limits)) == "poles");
    CHECK(field(analyse(std::vector<Pole>(kMostPoles + 1), 1, face, limits)) == "poles");
    CHECK(field(analyse({pole(45, 0, 1)}, 1, face, limits)) == "poles[0]");
    CHECK(field(analyse({pole(45, 0, 0, 0)}, 1, face, limits)) == "poles[0]");
    CHECK(field(analyse({{Vec3(0, 0, -1), 1, 0}}, 1, face, limits)) == "poles[0]");
    CHECK(field(analyse({{Vec3(0, 0, 2), 1, 0}}, 1, face, limits)) == "poles[0]");
}
