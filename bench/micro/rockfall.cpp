// Rocks that fall on a survey. A step should cost what it costs on a plane, however many triangles the
// ground has. As bench/rock_mass/rockfall.py has it for the command line.

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <random>

#include "process.h"
#include "suite.h"
#include "talus/rock_mass.h"
#include "talus/simulation.h"
#include "talus/surface.h"

namespace talus::bench {
namespace {

constexpr double kSlope = 0.6, kRoughness = 0.25, kBase = -5.0;  // of a metre per metre; [m]
constexpr int kRocks = 20, kRow = 4;
constexpr double kHeight = 3.0, kSpacing = 1.5, kRadius = 0.4;  // of the rocks [m]
constexpr double kDuration = 1.0;                               // [s] they land after 0.8

/// The same numbers with every standard library.
class Dice {
 public:
    double operator()(double low, double high) { return low + (high - low) * (engine_() / 4294967296.0); }

 private:
    std::mt19937 engine_{5};
};

/// Heights of a hillside, rough in waves of some 3 to 20 m.
class Hillside {
 public:
    explicit Hillside(double roughness) : roughness_(roughness) {
        Dice dice;
        for (Wave& wave : waves_) wave = {dice(0.3, 2), dice(0, 2 * M_PI), dice(0, 2 * M_PI)};
    }
    double at(double x, double y) const {
        double rough = 0;
        for (const Wave& w : waves_)
            rough += std::cos(w.number * (x * std::cos(w.way) + y * std::sin(w.way)) + w.phase);
        return kSlope * x + roughness_ * rough / std::sqrt(static_cast<double>(waves_.size()));
    }

 private:
    struct Wave {
        double number, way, phase;
    };
    std::array<Wave, 25> waves_{};
    double roughness_;
};

/// n x n squares of a metre, two triangles each.
Polyhedron terrain(const Hillside& hillside, int n) {
    TriangleSurface open;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) open.vertices.emplace_back(i, j, hillside.at(i, j));
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const int at = j * (n + 1) + i;
            open.triangles.push_back({at, at + 1, at + n + 2});
            open.triangles.push_back({at, at + n + 2, at + n + 1});
        }
    return *solidOf(closeTerrain(std::move(open), kBase)->surface);
}

/// A prism whose top is the slope.
Polyhedron plane(int n) {
    std::vector<Vec3> corners;
    for (const double x : {0.0, 1.0 * n})
        for (const double y : {0.0, 1.0 * n}) {
            corners.emplace_back(x, y, kBase);
            corners.emplace_back(x, y, kSlope * x);
        }
    return *convexHull(corners);
}

Block blockOf(std::string name, Polyhedron shape, Motion motion) {
    Block block;
    block.name = std::move(name);
    block.shape = std::move(shape);
    block.density = 2600;
    block.motion = motion;
    block.face_joint.assign(block.shape.faces.size(), 0);
    return block;
}

Model rockfall(const Hillside& hillside, Polyhedron ground, int n) {
    Model model;
    Joint joint;
    joint.name = "default";
    joint.normal_stiffness = joint.shear_stiffness = 1e9;
    joint.friction = joint.residual_friction = 35 * M_PI / 180;
    joint.restitution_normal = 0.3;
    model.joints = {joint};
    model.blocks.push_back(blockOf("ground", std::move(ground), Motion::fixed));
    Dice dice;
    for (int k = 0; k < kRocks; ++k) {
        const double x = 0.5 * n + kSpacing * (k / kRow), y = 0.5 * n + kSpacing * (k % kRow);
        const Vec3 centre(x, y, hillside.at(x, y) + kHeight);
        std::vector<Vec3> points;
        while (points.size() < 9) {
            const Vec3 p(dice(-1, 1), dice(-1, 1), dice(-1, 1));
            if (p.norm() > 0.5 && p.norm() < 1) points.push_back(centre + kRadius * p);
        }
        model.blocks.push_back(blockOf("rock " + std::to_string(k + 1), *convexHull(points), Motion::free));
    }
    model.run.duration = kDuration;
    return model;
}

struct Fall {
    std::shared_ptr<const Model> model;
    double ground_seconds = 0;  ///< wall time for the ground's shape
};

/// \param n  squares along each side; 0: a plane
const Fall& fallOnto(int n) {
    static std::optional<std::pair<int, Fall>> last;
    if (last && last->first == n) return last->second;
    constexpr int kSide = 100;
    const Hillside hillside(n > 0 ? kRoughness : 0.0);
    const double start = wallSeconds();
    Polyhedron ground = n > 0 ? terrain(hillside, n) : plane(kSide);
    const double seconds = wallSeconds() - start;
    Model model = rockfall(hillside, std::move(ground), n > 0 ? n : kSide);
    last = {n, {std::make_shared<const Model>(std::move(model)), seconds}};
    return last->second;
}

void rockfallBenchmark(benchmark::State& run, int n) {
    const Fall& fall = fallOnto(n);
    double start_seconds = kInfinity, steps = 0;
    for (auto _ : run) {
        run.PauseTiming();
        const double start = wallSeconds();
        auto simulation = Simulation::begin(fall.model, {.threads = 1});
        if (!simulation) return run.SkipWithError(simulation.errors().front().message.c_str());
        start_seconds = std::min(start_seconds, wallSeconds() - start);
        run.ResumeTiming();
        constexpr std::int64_t kAtOnce = 1000;
        while (simulation->time() < kDuration) {
            if (const auto errors = simulation->step(kAtOnce, {.threads = 1}); !errors.empty())
                return run.SkipWithError(errors.front().message.c_str());
        }
        char hash[17];
        std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(simulation->stateHash()));
        run.SetLabel(hash);
        steps = static_cast<double>(simulation->steps());
    }
    run.counters["run_steps"] = steps;
    run.counters["start_seconds"] = start_seconds;
    run.counters["ground_seconds"] = fall.ground_seconds;
}

}  // namespace

void addRockfalls(const Extent& extent) {
    constexpr std::int64_t kOnce = 1;
    constexpr int kPlane = 0, kTrianglesPerSquare = 2;
    // 1,000, 30,000 and 100,000 triangles.
    for (const int squares : {kPlane, 22, 122, 224}) {
        const int triangles = kTrianglesPerSquare * squares * squares;
        if (triangles > extent.largest) break;
        const std::string name =
            "rockfall/" + (squares == kPlane ? std::string("plane") : std::to_string(triangles));
        add(
            extent, name, 1, [=](benchmark::State& run) { rockfallBenchmark(run, squares); }, kOnce);
    }
}

}  // namespace talus::bench
