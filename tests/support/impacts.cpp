#include "support/impacts.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "contacts/update.h"
#include "measure/measure.h"
#include "state/block_motion.h"
#include "step/energy_keeper.h"
#include "step/step.h"
#include "step/time_step.h"
#include "support/models.h"

namespace talus::test {
namespace {

constexpr double kStepSafety = 0.03;  // as a history in which blocks fly
constexpr int kStepsPerLook = 10;
constexpr long kMostSteps = 300'000;

Vec3 direction(std::mt19937_64& random) {
    std::normal_distribution<double> number;
    const double x = number(random), y = number(random), z = number(random);
    return Vec3(x, y, z).normalized();
}

double share(std::mt19937_64& random) { return std::uniform_real_distribution<double>(0, 1)(random); }

Block randomRock(std::mt19937_64& random, const std::string& name, const Vec3& centre, double size) {
    const int count = 6 + static_cast<int>(8 * share(random));
    Vec3 stretch;
    for (double& s : stretch) s = 0.6 + 0.8 * share(random);
    std::vector<Vec3> points;
    for (int k = 0; k < count; ++k) {
        const double radius = size * (0.7 + 0.3 * share(random));
        points.push_back(centre + radius * direction(random).cwiseProduct(stretch));
    }
    return hullBlock(name, points);
}

/// Cubes of a lattice, each on a face of an earlier one, all sheared and stretched alike.
Block randomBody(std::mt19937_64& random, const std::string& name, const Vec3& centre, double size) {
    const int count = 2 + static_cast<int>(4 * share(random));
    std::vector<Vec3> cells{Vec3::Zero()};
    while (static_cast<int>(cells.size()) < count) {
        Vec3 next = cells[static_cast<std::size_t>(share(random) * static_cast<double>(cells.size()))];
        next[static_cast<Eigen::Index>(3 * share(random))] += share(random) < 0.5 ? -1 : 1;
        if (std::find(cells.begin(), cells.end(), next) == cells.end()) cells.push_back(next);
    }
    Mat3 shear;
    for (Eigen::Index k = 0; k < 3; ++k)
        shear.col(k) = (0.7 + 0.6 * share(random)) * (Vec3::Unit(k) + 0.25 * direction(random));
    Vec3 middle = Vec3::Zero();
    for (const Vec3& cell : cells) middle += cell / count;
    double reach = 0;
    for (const Vec3& cell : cells) reach = std::max(reach, (shear * (cell - middle)).norm() + 1.3);
    std::vector<Polyhedron> parts;
    for (const Vec3& cell : cells) {
        Polyhedron part = *makeBox(cell - middle - Vec3::Constant(0.5), cell - middle + Vec3::Constant(0.5));
        for (Vec3& v : part.vertices) v = centre + size / reach * (shear * v);
        parts.push_back(std::move(part));
    }
    Block block = hullBlock(name, parts[0].vertices);
    Result<Polyhedron> shape = joinParts(parts);
    REQUIRE(shape.ok());
    block.shape = *shape;
    block.face_joint.assign(block.shape.faces.size(), 0);
    return block;
}

/// Momentum and angular momentum of the free blocks, and what they are to be compared with.
struct Momenta {
    Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
    double linear_scale = 0, angular_scale = 0;
};

Momenta momentaOf(const State& state) {
    Momenta sum;
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (state.blocks.motion[b] != Motion::free) continue;
        const Vec3 p = state.blocks.velocity.get(b) / state.blocks.inverse_mass[b];
        const Vec3 x = state.blocks.position.get(b), l = state.blocks.angular_momentum.get(b);
        sum.linear += p;
        sum.angular += x.cross(p) + l;
        sum.linear_scale += p.norm();
        sum.angular_scale += x.norm() * p.norm() + l.norm();
    }
    return sum;
}

double timeStep(const State& state) {
    const std::vector<double> bounds = frequencyBounds(state, false);
    return kStepSafety *
           stableTimeStep(*std::max_element(bounds.begin(), bounds.end()), state.damping.contact);
}

/// Follows the energy of an impact.
struct EnergyLog {
    ImpactGains gains{};
    double now = 0, least = kInfinity;

    /// Adds what came since the last time to `where`.
    void add(const State& state, double& where) {
        const double energy = totalEnergy(state, false);
        where += std::max(0.0, energy - now);
        now = energy;
    }
    /// As a record of a history would have it.
    void record() {
        gains.above_least = std::max(gains.above_least, now - least);
        least = std::min(least, now);
    }
};

}  // namespace

Block hullBlock(const std::string& name, const std::vector<Vec3>& points, Motion motion) {
    Result<Polyhedron> shape = convexHull(points);
    REQUIRE(shape.ok());
    Block block;
    block.name = name;
    block.shape = *shape;
    block.density = 2700;
    block.motion = motion;
    block.face_joint.assign(block.shape.faces.size(), 0);
    block.field = "block";
    return block;
}

Model rockOverSlope(double stiffness, double contact_damping, double friction_deg) {
    Model model;
    model.joints = {joint(friction_deg, stiffness)};
    model.damping.contact = contact_damping;
    model.blocks = {hullBlock("slope",
                              {{0, -10, 0},
                               {0, 10, 0},
                               {40, -10, 33.56},
                               {40, 10, 33.56},
                               {40, -10, -5},
                               {40, 10, -5},
                               {0, -10, -5},
                               {0, 10, -5}},
                              Motion::fixed),
                    box("valley", {-60, -10, -5}, {0, 10, 0}, 2700, Motion::fixed),
                    hullBlock("rock", {{33, -0.5, 31},
                                       {34, -0.5, 31.2},
                                       {34, 0.5, 31.1},
                                       {33, 0.6, 31},
                                       {33.1, -0.4, 32},
                                       {34, -0.3, 32.1},
                                       {33.8, 0.5, 32.2},
                                       {33.1, 0.4, 31.9}})};
    return model;
}

RandomImpact randomImpact(unsigned seed, Rocks rocks) {
    std::mt19937_64 random(seed);
    const auto rock = rocks == Rocks::convex ? randomRock : randomBody;
    RandomImpact impact;
    Model& model = impact.model;
    const double stiffness = std::pow(10.0, 8 + 3 * share(random));
    const bool damped = share(random) < 0.5, frictional = share(random) < 0.5;
    model.damping.contact = damped ? std::pow(10.0, -6 + 2 * share(random)) : 0.0;
    model.joints = {joint(frictional ? 10 + 35 * share(random) : 0.0, stiffness)};
    impact.two_free = share(random) < 0.5;
    const double speed = 2 + 8 * share(random), y = share(random) - 0.5, z = share(random) - 0.5;
    if (impact.two_free) {
        model.gravity.magnitude = 0;
        model.blocks.push_back(rock(random, "one", {0, 0, 0}, 0.5));
        model.blocks.push_back(rock(random, "two", {1.6, 0.4 * y, 0.4 * z}, 0.3 + 0.4 * share(random)));
        model.blocks[1].velocity = {-speed, 0.5 * z, 0.5 * y};
    } else {
        model.blocks.push_back(box("floor", {-5, -5, -1}, {5, 5, 0}, 2700, Motion::fixed));
        model.blocks.push_back(rock(random, "one", {0, 0, 1}, 0.5));
        model.blocks[1].velocity = {4 * y, 4 * z, -speed};
    }
    for (const Block& block : model.blocks) {
        const Vec3 axis = direction(random);
        const double spin = 5 * share(random);
        impact.spin.push_back(block.motion == Motion::free ? Vec3(spin * axis) : Vec3(Vec3::Zero()));
    }
    return impact;
}

void setSpin(State& state, const std::vector<Vec3>& spin) {
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (state.blocks.motion[b] != Motion::free) continue;
        const Mat3 turn = state.blocks.orientation.matrix(b);
        const Vec3 own = state.blocks.inertia.get(b).cwiseProduct(turn.transpose() * spin[b]);
        state.blocks.angular_momentum.set(b, turn * own);
    }
}

ImpactGains runImpact(State state, TakeBack take_back, double parted) {
    state.springs = Springs::keep_energy;
    updateForces(state, false);
    const Momenta first = momentaOf(state);
    double dt = timeStep(state), apart_since = kInfinity;
    EnergyLog log;
    ImpactGains& gains = log.gains;
    log.now = totalEnergy(state, false);
    for (long k = 0; k < kMostSteps && state.time < apart_since + parted; k += kStepsPerLook) {
        const double energy = log.now;
        for (int s = 0; s < kStepsPerLook; ++s) {
            advance(state, {dt, false}, 1, [&](int) { state.time += dt; });
            log.add(state, gains.steps);
            const double elastic = elasticEnergy(state);
            gains.largest_kinetic = std::max(gains.largest_kinetic, kineticEnergy(state));
            gains.largest_elastic = std::max(gains.largest_elastic, elastic);
            if (elastic > 0)
                apart_since = kInfinity;
            else if (gains.largest_elastic > 0)
                apart_since = std::min(apart_since, state.time);
        }
        if (take_back == TakeBack::yes) {
            takeBack(state, log.now - energy, kStepsPerLook * dt, false);
            log.now = totalEnergy(state, false);
        }
        log.record();
        const bool searched = refreshInterfaces(state, false, kStepsPerLook * dt);
        log.add(state, searched ? gains.searches : gains.looks);
        log.record();
        if (searched) dt = timeStep(state);
    }
    const Momenta last = momentaOf(state);
    gains.momentum_drift = (last.linear - first.linear).norm() / first.linear_scale;
    gains.angular_drift = (last.angular - first.angular).norm() / first.angular_scale;
    return gains;
}

}  // namespace talus::test
