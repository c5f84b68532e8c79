// The stages of a step, each alone and all together, on slopes of growing size.

#include <algorithm>
#include <cmath>

#include "counts.h"
#include "detection/neighbours.h"
#include "process.h"
#include "stages/contacts.h"
#include "stages/measure.h"
#include "stages/motion.h"
#include "stages/patches.h"
#include "stages/step.h"
#include "state/build.h"
#include "suite.h"

namespace talus::bench {
namespace {

constexpr std::size_t kGroups = 64, kBlocks = 512;  // pieces, as in stages/step.cpp

Facts times(double n, const Counts& counts) {
    return {.flops = n * counts.flops,
            .divisions = n * counts.divisions,
            .roots = n * counts.roots,
            .bytes = n * counts.bytes(),
            .working_set = n * counts.bytes()};
}

Facts operator+(Facts a, const Facts& b) {
    a.flops += b.flops;
    a.divisions += b.divisions;
    a.roots += b.roots;
    a.bytes += b.bytes;
    a.working_set += b.working_set;
    return a;
}

/// Contacts: the interfaces, and each block's pose once (7 doubles).
Facts contactFacts(const Slope& slope, bool slips) {
    Counts pose;
    pose.read = 7 * sizeof(double);
    Facts facts = times(static_cast<double>(slope.interfaces()), countInterface(slope.kind.points, slips)) +
                  times(static_cast<double>(slope.blocks()), pose);
    facts.points = static_cast<double>(slope.points());
    return facts;
}

Facts blockFacts(const Slope& slope, const Counts& counts) {
    Facts facts = times(static_cast<double>(slope.blocks()), counts);
    facts.points = static_cast<double>(slope.points());
    return facts;
}

Facts stepFacts(const Slope& slope) {
    Facts facts =
        contactFacts(slope, false) + blockFacts(slope, countDrift()) + blockFacts(slope, countGather());
    facts.points = static_cast<double>(slope.points());
    return facts;
}

/// Shares of the Lps that are open, and that carry all the shear they can.
void tellContacts(benchmark::State& run, const State& state) {
    double open = 0;
    const std::size_t stride = std::max<std::size_t>(1, state.interfaces.size() / 20000);
    double seen = 0;
    for (std::size_t i = 0; i < state.interfaces.size(); i += stride)
        for (const stages::PointState& point : stages::pointStates(state, i)) {
            ++seen;
            open += point.force.open ? 1 : 0;
        }
    run.counters["open"] = open / seen;
}

void contactBenchmark(benchmark::State& run, const SlopeKind& kind, int threads, simd::InstructionSet set) {
    Slope& slope = slopeFor(kind);
    State& state = slope.state;
    const simd::InstructionSet usual = state.instructions;
    state.instructions = set;
    onThreads(threads, [&] {
        for (auto _ : run)
            forRange(state.interfaces.groups.size(), kGroups, threads > 1,
                     [&](Range range) { stages::updateContacts(state, range); });
    });
    state.instructions = usual;
    tell(run, contactFacts(slope, false));
    tellContacts(run, state);
}

/// All Lps move between two places so far apart that every closed one slips each time.
void slippingBenchmark(benchmark::State& run, const SlopeKind& kind) {
    constexpr double kShift = 1e-6;  // ten times what the weight presses a joint together
    Slope& slope = slopeFor(kind);
    State& state = slope.state;
    const Moved before = movedPartOf(state);
    std::vector<double> other = state.blocks.position.y;
    const auto rows = static_cast<std::size_t>(kind.blocks == 105 ? 5 : 10);
    for (std::size_t b = 1; b < other.size(); ++b)
        if ((b - 1) / (kind.blocks == 105 ? 3u : 10u) % rows % 2 == 0) other[b] += kShift;
    for (auto _ : run) {
        state.blocks.position.y.swap(other);
        stages::updateContacts(state, {0, state.interfaces.groups.size()});
    }
    restore(state, before);
    tell(run, contactFacts(slope, true));
}

void gatherBenchmark(benchmark::State& run, const SlopeKind& kind, int threads) {
    Slope& slope = slopeFor(kind);
    const Moved before = movedPartOf(slope.state);
    onThreads(threads, [&] {
        for (auto _ : run)
            forRange(slope.blocks(), kBlocks, threads > 1,
                     [&](Range range) { stages::gather(slope.state, range, 0.0); });
    });
    restore(slope.state, before);
    tell(run, blockFacts(slope, countGather()));
}

void driftBenchmark(benchmark::State& run, const SlopeKind& kind, int threads) {
    Slope& slope = slopeFor(kind);
    const Moved before = movedPartOf(slope.state);
    onThreads(threads, [&] {
        for (auto _ : run)
            forRange(slope.blocks(), kBlocks, threads > 1,
                     [&](Range range) { stages::drift(slope.state, range, 1e-12); });
    });
    restore(slope.state, before);
    tell(run, blockFacts(slope, countDrift()));
}

/// The same number of steps from the same state each time, so that the hash at the end is the same for any number of
/// threads.
void stepBenchmark(benchmark::State& run, const SlopeKind& kind, int threads) {
    Slope& slope = slopeFor(kind);
    const Moved before = movedPartOf(slope.state);
    onThreads(threads, [&] {
        for (auto _ : run) stages::advance(slope.state, {slope.time_step, threads > 1});
    });
    char hash[17];
    std::snprintf(hash, sizeof hash, "%016llx",
                  static_cast<unsigned long long>(stages::stateHash(slope.state)));
    run.SetLabel(hash);
    restore(slope.state, before);
    tell(run, stepFacts(slope));
    run.counters["state_bytes"] = slope.state_bytes;
    run.counters["peak_bytes"] = slope.peak_bytes;
    run.counters["blocks"] = static_cast<double>(slope.blocks());
    run.counters["model_seconds"] = slope.model_seconds;
    run.counters["build_seconds"] = slope.build_seconds;
    run.counters["build_cpu"] = slope.build_cpu;
}

std::vector<Box> boxesOf(const State& state) {
    std::vector<Box> boxes(state.blocks.size());
    for (std::size_t b = 0; b < boxes.size(); ++b) {
        const Polyhedron shape = placedShape(state, b);
        boxes[b] = {Vec3::Constant(kInfinity), Vec3::Constant(-kInfinity)};
        for (const Vec3& v : shape.vertices) {
            boxes[b].min = boxes[b].min.cwiseMin(v).eval();
            boxes[b].max = boxes[b].max.cwiseMax(v).eval();
        }
        boxes[b].min.array() -= 0.0025;  // half the margin of the engine's own search
        boxes[b].max.array() += 0.0025;
    }
    return boxes;
}

void neighbourBenchmark(benchmark::State& run, const SlopeKind& kind, int threads) {
    const std::vector<Box> boxes = boxesOf(slopeFor(kind).state);
    std::size_t pairs = 0;
    onThreads(threads, [&] {
        for (auto _ : run) pairs = findNeighbours(boxes, threads > 1).size();
    });
    run.counters["points"] = static_cast<double>(boxes.size());
    run.counters["pairs"] = static_cast<double>(pairs);
}

void interfaceBenchmark(benchmark::State& run, const SlopeKind& kind, int threads) {
    Slope& slope = slopeFor(kind);
    onThreads(threads, [&] {
        for (auto _ : run) stages::findInterfaces(slope.state, false, threads > 1);
    });
    stages::updateForces(slope.state, true);
    run.counters["points"] = static_cast<double>(slope.blocks());
}

/// Iterations for about as long as the other benchmarks take, the same ones for every number of threads.
std::int64_t stepsFor(const Extent& extent, int blocks) {
    constexpr double kSecondsPerBlock = 1.5e-7;
    return std::max<std::int64_t>(3, static_cast<std::int64_t>(extent.seconds / (kSecondsPerBlock * blocks)));
}

void addSlope(const Extent& extent, const SlopeKind& kind) {
    using simd::InstructionSet;
    const std::string slope = "/" + kind.name();
    const bool plain = kind.filling == Filling::plain;
    const bool whole = plain && kind.points.kind == PointRule::Kind::vertex;
    for (const int threads : {1, extent.threads}) {
        if (plain && threads == 1)
            add(extent, "contacts, scalar" + slope, 1,
                [=](benchmark::State& run) { contactBenchmark(run, kind, 1, InstructionSet::scalar); });
        add(extent, "contacts" + slope, threads,
            [=](benchmark::State& run) { contactBenchmark(run, kind, threads, simd::bestInstructionSet()); });
        if (plain && threads == 1 && kind.blocks <= 1000)
            add(extent, "contacts, all slip" + slope, 1,
                [=](benchmark::State& run) { slippingBenchmark(run, kind); });
        if (whole) {
            add(extent, "gather" + slope, threads,
                [=](benchmark::State& run) { gatherBenchmark(run, kind, threads); });
            add(extent, "drift" + slope, threads,
                [=](benchmark::State& run) { driftBenchmark(run, kind, threads); });
        }
        add(extent, "step" + slope, threads, [=](benchmark::State& run) {
            stepBenchmark(run, kind, threads);
        })->Iterations(stepsFor(extent, kind.blocks));
        if (whole) {
            add(extent, "neighbours" + slope, threads,
                [=](benchmark::State& run) { neighbourBenchmark(run, kind, threads); });
            add(extent, "interfaces" + slope, threads,
                [=](benchmark::State& run) { interfaceBenchmark(run, kind, threads); });
        }
        if (extent.threads == 1) break;
    }
}

}  // namespace

void addSlopes(const Extent& extent) {
    constexpr PointRule kVertex{PointRule::Kind::vertex, 0}, kCorner{PointRule::Kind::corner, 0},
        kGrid{PointRule::Kind::grid, 4};
    for (const int blocks : kSizes) {
        if (blocks > extent.largest) break;
        for (const PointRule rule : {kCorner, kVertex, kGrid})
            addSlope(extent, {blocks, rule, Filling::plain});
        if (blocks != 105 && blocks != 10000) continue;
        for (const Filling filling : {Filling::water, Filling::cohesion, Filling::mixed})
            addSlope(extent, {blocks, kVertex, filling});
    }
}

}  // namespace talus::bench
