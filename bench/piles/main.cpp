// talus-piles [SEEDS|FIRST-LAST [ROCKS [SECONDS]]]: piles of random rocks dropped into a box, one a seed: how
// much their energy rose from one frame to the next at most, how deep two of them press into each other in
// the end, what still moves.
//   build/bench/talus-piles 10        ten piles as bench/verification/pile.toml has one
//   build/bench/talus-piles 4-4 250   the fourth alone, of 250 rocks

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <utility>

#include "build/build.h"
#include "contacts/overlap.h"
#include "frame/frame.h"
#include "talus/simulation.h"

using namespace talus;

namespace {

constexpr double kWidth = 1.2, kHeight = 3.4, kWall = 0.2;  // of the box [m]
constexpr double kCell = 0.15, kLayer = 0.1625;             // what each rock has at the start [m]
constexpr int kPerRow = 8;

Block blockOf(Polyhedron shape, const std::string& name, Motion motion) {
    Block block;
    block.name = name;
    block.shape = std::move(shape);
    block.density = 2700;
    block.motion = motion;
    block.face_joint.assign(block.shape.faces.size(), 0);
    block.field = name;
    return block;
}

void addWall(Model& model, const char* name, const Vec3& min, const Vec3& max) {
    model.blocks.push_back(blockOf(*makeBox(min, max), name, Motion::fixed));
}

/// The hull of nine points on a ball that is pressed flat here and there.
Polyhedron rock(std::mt19937_64& random, const Vec3& centre) {
    std::normal_distribution<double> number;
    std::uniform_real_distribution<double> share(0, 1);
    while (true) {
        std::vector<Vec3> points;
        for (int k = 0; k < 9; ++k) {
            Vec3 out;
            for (double& x : out) x = number(random);
            points.push_back(centre + (0.045 + 0.025 * share(random)) * out.normalized());
        }
        if (Result<Polyhedron> hull = convexHull(points)) return *hull;
    }
}

Model pile(unsigned seed, int rocks, double seconds) {
    Model model;
    Joint joint;
    joint.name = "default";
    joint.normal_stiffness = joint.shear_stiffness = 4e11;
    joint.friction = joint.residual_friction = 30.0 * M_PI / 180.0;
    model.joints = {joint};
    model.damping.contact = 1e-5;
    model.run.duration = seconds;
    model.run.time_step = 1.5e-6;
    model.run.frame_interval = 0.01;
    addWall(model, "floor", {-kWall, -kWall, -kWall}, {kWidth + kWall, kWidth + kWall, 0});
    addWall(model, "west", {-kWall, -kWall, 0}, {0, kWidth + kWall, kHeight});
    addWall(model, "east", {kWidth, -kWall, 0}, {kWidth + kWall, kWidth + kWall, kHeight});
    addWall(model, "south", {0, -kWall, 0}, {kWidth, 0, kHeight});
    addWall(model, "north", {0, kWidth, 0}, {kWidth, kWidth + kWall, kHeight});
    std::mt19937_64 random(seed);
    for (int k = 0; k < rocks; ++k) {
        const int layer = k / (kPerRow * kPerRow), row = k / kPerRow % kPerRow;
        const Vec3 centre(kCell * (0.5 + k % kPerRow), kCell * (0.5 + row), 0.125 + kLayer * layer);
        model.blocks.push_back(blockOf(rock(random, centre), "r" + std::to_string(k + 1), Motion::free));
    }
    return model;
}

/// \return whether it could be run
bool drop(unsigned seed, int rocks, double seconds) {
    const Model model = pile(seed, rocks, seconds);
    double first = 0, before = 0, gain = 0, kinetic = 0;
    bool started = false;
    FullFrame last;
    RunOutput output;
    output.record = [&](const HistoryRecord& r) {
        const double total = r.kinetic_energy + r.elastic_energy + r.gravity_energy;
        if (!started) first = total;
        if (started) gain = std::max(gain, total - before);
        started = true;
        before = total;
        kinetic = r.kinetic_energy;
    };
    output.full = [&](FullFrame&& frame) { last = std::move(frame); };
    const Result<RunResult> result = run(model, {}, output);
    Result<State> state = buildState(keptByCaller(model), false);
    if (!result || !state || !restoreFrame(last, *state).empty()) {
        std::fprintf(stderr, "seed %u: %s\n", seed, result ? "no frame" : result.errors()[0].message.c_str());
        return false;
    }
    const double fallen = first - before;
    std::printf("%6u %10.1f %12.2e %12.2e %12.2e %10.1f\n", seed, fallen, gain / fallen,
                greatestOverlap(*state), kinetic / fallen, result->wall_seconds);
    std::fflush(stdout);
    return true;
}

}  // namespace

int main(int count, char** words) {
    unsigned first = 1, last = 10;
    int rocks = 1000, rest = 0;
    double seconds = 1.5;
    bool understood = count <= 4;
    if (count > 1) {
        const int read = std::sscanf(words[1], "%u%n-%u%n", &first, &rest, &last, &rest);
        understood = understood && read > 0 && words[1][rest] == '\0';
        if (read == 1) last = std::exchange(first, 1);
    }
    const auto number = [&](int k, const char* format, auto& value) {
        if (count > k)
            understood =
                understood && std::sscanf(words[k], format, &value, &rest) == 1 && words[k][rest] == '\0';
    };
    number(2, "%d%n", rocks);
    number(3, "%lf%n", seconds);
    if (!understood || first < 1 || last < first || rocks < 1 || !(seconds > 0)) {
        std::fprintf(stderr, "usage: talus-piles [SEEDS|FIRST-LAST [ROCKS [SECONDS]]]\n");
        return 2;
    }
    std::printf("  seed   fallen, J  gain/fallen  overlap/size  moves/fallen    wall, s\n");
    bool ran = true;
    for (unsigned seed = first; seed <= last; ++seed) ran = drop(seed, rocks, seconds) && ran;
    return ran ? 0 : 1;
}
