// The stages of a step, each alone and all together, on slopes of growing size.

#include <algorithm>
#include <cmath>

#include "build/build.h"
#include "contacts/neighbours.h"
#include "contacts/update.h"
#include "counts.h"
#include "forces/contact_forces.h"
#include "measure/measure.h"
#include "process.h"
#include "state/placed_shape.h"
#include "step/motion.h"
#include "step/step.h"
#include "suite.h"

namespace talus::bench {
namespace {

constexpr std::size_t kGroups = 64, kBlocks = 512;  // pieces, as in step/step.cpp
constexpr int kSteps = 10;                          // taken at once, as in the analyses

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
    a.points += b.points;
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
    const Facts contacts = contactFacts(slope, false), both = blockFacts(slope, countGatherAndDrift());
    Facts facts = blockFacts(slope, countDrift()) + contacts + blockFacts(slope, countGather());
    for (int k = 1; k < kSteps; ++k) facts = facts + contacts + both;
    facts.working_set = (contacts + both).working_set;
    facts.points = kSteps * static_cast<double>(slope.points());
    return facts;
}

/// Shares of the contact points that are open, and of the patches that are open in one part only: a patch of
/// the rule "distributed" takes longer there.
void tellContacts(benchmark::State& run, const State& state) {
    double open = 0, patches = 0, partly = 0;
    const std::size_t stride = std::max<std::size_t>(1, state.interfaces.size() / 20000);
    double seen = 0;
    for (std::size_t i = 0; i < state.interfaces.size(); i += stride) {
        const auto points = contactPoints(state, i);
        const auto gaping = std::count_if(points.begin(), points.end(),
                                          [](const ContactPoint& point) { return point.force.open; });
        const auto all = static_cast<std::ptrdiff_t>(points.size());
        seen += static_cast<double>(all);
        open += static_cast<double>(gaping);
        ++patches;
        partly += gaping > 0 && gaping < all ? 1 : 0;
    }
    run.counters["open"] = open / seen;
    run.counters["patches_partly_open"] = partly / patches;
}

void contactBenchmark(benchmark::State& run, const SlopeKind& kind, int threads, simd::InstructionSet set) {
    Slope& slope = slopeFor(kind);
    State& state = slope.state;
    const simd::InstructionSet usual = state.instructions;
    state.instructions = set;
    onThreads(threads, [&] {
        for (auto _ : run)
            forRange(state.interfaces.groups.size(), kGroups, threads > 1,
                     [&](Range range) { updateContacts(state, range); });
    });
    state.instructions = usual;
    tell(run, contactFacts(slope, false));
    tellContacts(run, state);
}

/// The slope drawn together until no patch is open anywhere.
void closedBenchmark(benchmark::State& run, const SlopeKind& kind) {
    constexpr double kCloser = 1e-5;  // of all distances: some ten times what the weight presses a joint
    State& state = slopeFor(kind).state;
    for (std::size_t b = 0; b < state.blocks.size(); ++b)
        state.blocks.position.set(b, (1 - kCloser) * state.blocks.position.get(b));
    for (auto _ : run) updateContacts(state, {0, state.interfaces.groups.size()});
    tellContacts(run, state);
    tell(run, contactFacts(slopeFor(kind), false));
}

/// Every other row of the paper's slope moves to and fro, so far that every closed contact point of the beds
/// and the joints between columns slips each time (those between slices open and close).
void slippingBenchmark(benchmark::State& run, const SlopeKind& kind) {
    constexpr double kShift = 1e-6;  // [m] ten times what the weight presses a joint together
    constexpr std::size_t kRows = 5, kSlices = 3;
    State& state = slopeFor(kind).state;
    PositionArray other = state.blocks.position;
    for (std::size_t b = 1; b < other.size(); ++b)
        if ((b - 1) / kSlices % kRows % 2 == 0) other[b].y += kShift;
    for (auto _ : run) {
        state.blocks.position.swap(other);
        updateContacts(state, {0, state.interfaces.groups.size()});
    }
    tell(run, contactFacts(slopeFor(kind), true));
}

void gatherBenchmark(benchmark::State& run, const SlopeKind& kind, int threads) {
    Slope& slope = slopeFor(kind);
    onThreads(threads, [&] {
        for (auto _ : run)
            forRange(slope.blocks(), kBlocks, threads > 1,
                     [&](Range range) { gather(slope.state, range, 0.0); });
    });
    tell(run, blockFacts(slope, countGather()));
}

void driftBenchmark(benchmark::State& run, const SlopeKind& kind, int threads) {
    Slope& slope = slopeFor(kind);
    onThreads(threads, [&] {
        for (auto _ : run)
            forRange(slope.blocks(), kBlocks, threads > 1,
                     [&](Range range) { drift(slope.state, range, 1e-12); });
    });
    tell(run, blockFacts(slope, countDrift()));
}

void gatherAndDriftBenchmark(benchmark::State& run, const SlopeKind& kind, int threads) {
    Slope& slope = slopeFor(kind);
    onThreads(threads, [&] {
        for (auto _ : run)
            forRange(slope.blocks(), kBlocks, threads > 1,
                     [&](Range range) { gatherAndDrift(slope.state, range, 1e-12); });
    });
    tell(run, blockFacts(slope, countGatherAndDrift()));
}

/// The same number of steps from the same state each time, so that the hash at the end is the same for any
/// number of threads.
void stepBenchmark(benchmark::State& run, const SlopeKind& kind, int threads) {
    Slope& slope = slopeFor(kind);
    onThreads(threads, [&] {
        for (auto _ : run) advance(slope.state, {slope.time_step, threads > 1}, kSteps);
    });
    char hash[17];
    std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(stateHash(slope.state)));
    run.SetLabel(hash);
    tell(run, stepFacts(slope));
    run.counters["steps_at_once"] = kSteps;  // which the row's seconds, points, flops and bytes are of
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
        for (auto _ : run) findInterfaces(slope.state, false, threads > 1);
    });
    run.counters["points"] = static_cast<double>(slope.blocks());
}

/// Iterations for about as long as the other benchmarks take, the same ones for every number of threads.
std::int64_t stepsFor(const Extent& extent, int blocks) {
    constexpr double kSecondsPerBlock = 1.5e-7;
    return std::max<std::int64_t>(
        1, static_cast<std::int64_t>(extent.seconds / (kSecondsPerBlock * kSteps * blocks)));
}

/// Threads that a stage is measured with: below some thousand blocks the engine uses one.
std::vector<int> threadsFor(const Extent& extent, int blocks) {
    if (extent.threads == 1 || blocks < 10000) return {1};
    return {1, extent.threads};
}

using Body = void (*)(benchmark::State&, const SlopeKind&, int threads);

void addStage(const Extent& extent, const char* stage, const SlopeKind& kind, Body body,
              std::int64_t iterations = 0) {
    for (const int threads : threadsFor(extent, kind.blocks))
        add(
            extent, std::string(stage) + "/" + kind.name(), threads,
            [=](benchmark::State& run) { body(run, kind, threads); }, iterations);
}

/// The search for interfaces comes last, because it changes them.
void addSlope(const Extent& extent, const SlopeKind& kind) {
    const bool plain = kind.filling == Filling::plain;
    const bool whole = plain && kind.points.kind == PointRule::Kind::vertex;
    if (plain)
        add(extent, "contacts, scalar/" + kind.name(), 1,
            [=](benchmark::State& run) { contactBenchmark(run, kind, 1, simd::InstructionSet::scalar); });
    if (plain && kind.blocks == 105 && simd::bestInstructionSet() == simd::InstructionSet::avx512)
        add(extent, "contacts, AVX2/" + kind.name(), 1,
            [=](benchmark::State& run) { contactBenchmark(run, kind, 1, simd::InstructionSet::avx2); });
    addStage(extent, "contacts", kind, [](benchmark::State& run, const SlopeKind& slope, int threads) {
        contactBenchmark(run, slope, threads, simd::bestInstructionSet());
    });
    if (plain && kind.blocks == 105) {
        add(extent, "contacts, all closed/" + kind.name(), 1,
            [=](benchmark::State& run) { closedBenchmark(run, kind); });
        add(extent, "contacts, all slip/" + kind.name(), 1,
            [=](benchmark::State& run) { slippingBenchmark(run, kind); });
    }
    if (whole) {
        addStage(extent, "gather", kind, gatherBenchmark);
        addStage(extent, "drift", kind, driftBenchmark);
        addStage(extent, "gather and drift", kind, gatherAndDriftBenchmark);
    }
    addStage(extent, "step", kind, stepBenchmark, stepsFor(extent, kind.blocks));
    if (whole) {
        addStage(extent, "neighbours", kind, neighbourBenchmark);
        addStage(extent, "interfaces", kind, interfaceBenchmark);
    }
}

}  // namespace

void addSlopes(const Extent& extent) {
    constexpr PointRule kVertex{PointRule::Kind::vertex, 0}, kDistributed{PointRule::Kind::distributed, 0},
        kCorner{PointRule::Kind::corner, 0}, kGrid{PointRule::Kind::grid, 4};
    for (const int blocks : kSizes) {
        if (blocks > extent.largest) break;
        for (const PointRule rule : {kCorner, kVertex, kDistributed, kGrid})
            addSlope(extent, {blocks, rule, Filling::plain});
        if (blocks != 105 && blocks != 10000) continue;
        for (const Filling filling : {Filling::water, Filling::cohesion, Filling::mixed, Filling::rough})
            addSlope(extent, {blocks, kVertex, filling});
    }
}

}  // namespace talus::bench
