#include "counts.h"

#include <array>
#include <cmath>
#include <vector>

#include "forces/contact_kernel.h"
#include "state/interface_frame.h"
#include "step/motion_kernel.h"

namespace talus::bench {
namespace {

Counts tally;  // of the counting numbers below; only this file's functions run them

/// A double that counts what is done with it.
struct Counting {
    double v = 0;
};
Counting flop(double v) {
    ++tally.flops;
    return {v};
}
bool choice(bool b) {
    ++tally.choices;
    return b;
}
Counting operator+(Counting a, Counting b) { return flop(a.v + b.v); }
Counting operator-(Counting a, Counting b) { return flop(a.v - b.v); }
Counting operator*(Counting a, Counting b) { return flop(a.v * b.v); }
Counting operator/(Counting a, Counting b) {
    ++tally.divisions;
    return {a.v / b.v};
}
Counting operator-(Counting a) { return {-a.v}; }
Counting operator+(Counting a, double b) { return b == 1.0 && a.v == 0 ? Counting{b} : flop(a.v + b); }
Counting operator-(Counting a, double b) { return flop(a.v - b); }
Counting operator*(double a, Counting b) { return flop(a * b.v); }
Counting operator*(Counting a, double b) { return flop(a.v * b); }
bool operator<(Counting a, Counting b) { return choice(a.v < b.v); }
bool operator>(Counting a, Counting b) { return choice(a.v > b.v); }
bool operator<(Counting a, double b) { return choice(a.v < b); }
[[maybe_unused]] bool operator>(Counting a, double b) { return choice(a.v > b); }
[[maybe_unused]] bool operator==(Counting a, double b) { return choice(a.v == b); }
Counting select(bool mask, Counting yes, Counting no) {
    ++tally.choices;
    return mask ? yes : no;
}
Counting larger(Counting a, Counting b) {
    ++tally.choices;
    return a.v > b.v ? a : b;
}
[[maybe_unused]] Counting smaller(Counting a, Counting b) {
    ++tally.choices;
    return a.v < b.v ? a : b;
}
Counting squareRoot(Counting a) {
    ++tally.roots;
    return {std::sqrt(a.v)};
}
Counting read(double v) {
    tally.read += sizeof v;
    return {v};
}
[[maybe_unused]] simd::FourOf<Counting> pieceAt(const simd::TablesOf<Counting>& tables, Counting x) {
    const double* piece = simd::pieceFor(tables.at, x.v);
    return {{read(piece[0]), read(piece[1]), read(piece[2]), read(piece[3])}};
}
void write(double& to, Counting v) {
    tally.written += sizeof to;
    to = v.v;
}

}  // namespace
}  // namespace talus::bench

namespace talus {
namespace {

using bench::Counting;

/// Members of a group as the kernel sees them. Blocks and laws are shared by many interfaces: their bytes
/// count elsewhere.
template <>
struct Members<Counting> {
    static constexpr int kWidth = 1;

    Members(const InterfaceGroup&, int) {}
    Counting load(const double* row) const { return bench::read(row[0]); }
    void store(double* row, Counting v) const { bench::write(row[0], v); }
    void storeWrench(double* to, const simd::Triple<Counting>& force, const simd::Triple<Counting>& moment_a,
                     const simd::Triple<Counting>& moment_b) const {
        for (const auto& v : {force, moment_a, moment_b})
            for (const Counting number : {v.x, v.y, v.z}) bench::write(*to++, number);
    }
    Counting take(const double* values) const { return bench::read(values[0]); }
    Counting gather(const double* values, const std::int32_t* index) const { return {values[index[0]]}; }
    Counting gather(const contact::JointLaw* laws, double contact::JointParameters<double>::*field,
                    const std::int32_t* index) const {
        return {laws[index[0]].*field};
    }
    bool gatherFlag(const contact::JointLaw* laws, bool contact::JointParameters<double>::*flag,
                    const std::int32_t* index) const {
        return laws[index[0]].*flag;
    }
    simd::TablesOf<Counting> gatherCurve(const contact::JointLaw* laws, const std::int32_t* index) const {
        return {laws[index[0]].curve.at};
    }
    PoseOf<Counting> gatherPose(const double* position, const double* orientation,
                                const std::int32_t*) const {
        const auto number = [](double v) { return Counting{v}; };
        return {{number(position[0]), number(position[1]), number(position[2])},
                simd::rotationOf(number(orientation[0]), number(orientation[1]), number(orientation[2]),
                                 number(orientation[3]))};
    }
};

template <>
struct Consecutive<Counting> {
    std::size_t block;
    Counting load(const double* values) const { return bench::read(values[block]); }
    void store(double* values, Counting v) const { bench::write(values[block], v); }
    bool flags(const std::uint8_t* values) const {
        bench::tally.read += 1;
        return values[block] != 0;
    }
    Four<Counting> loadFour(const double* r) const {
        return {bench::read(r[0]), bench::read(r[1]), bench::read(r[2]), bench::read(r[3])};
    }
    void storeFour(double* r, const Four<Counting>& v) const {
        bench::write(r[0], v.a), bench::write(r[1], v.b), bench::write(r[2], v.c), bench::write(r[3], v.d);
    }
};

}  // namespace
}  // namespace talus

namespace talus::bench {
namespace {

using simd::ConstVectors, simd::Vectors;

constexpr std::size_t kPlaces = 512;  // more than any patch here has

constexpr auto kRow = static_cast<std::size_t>(simd::kLanes);

contact::JointLaw frictional() {
    contact::JointLaw law;
    law.normal_stiffness = law.shear_stiffness = 1;
    law.tan_friction = 0.3;
    return law;
}

/// One interface between two blocks that press on each other, the upper one
/// slid far or not at all; a square patch.
struct OneInterface {
    std::vector<double> zero = std::vector<double>(kPlaces, 0.0), one = std::vector<double>(kPlaces, 1.0);
    std::vector<double> orientation{1, 0, 0, 0};
    std::vector<double> memory = zero, wrenches = zero;
    LaneArray frames{kFrameQuantities}, corners{kCornerQuantities};
    std::array<std::int32_t, 1> index{0};
    contact::JointLaw law = frictional();
    InterfaceGroup group;

    static PointPlaces placesOf(PointRule rule) {
        switch (rule.kind) {
            case PointRule::Kind::vertex:
            case PointRule::Kind::distributed:
                return PointPlaces::vertex;
            case PointRule::Kind::corner:
                return PointPlaces::corner;
            case PointRule::Kind::quarter:
            case PointRule::Kind::grid:
                break;
        }
        return PointPlaces::stored;
    }

    ContactView view(PointRule rule, bool slips) {
        constexpr double kDepth = -1e-6, kSlide = 1e-3;
        constexpr std::array<double, 4> kXi{-1, 1, 1, -1}, kEta{-1, -1, 1, 1};
        const double *z = zero.data(), *o = one.data();
        const ConstVectors none{z, z, z};
        frames.grow(kRow);
        setFrameAt(frames, 0,
                   {.e1_a = Vec3::UnitX(),
                    .e2_a = Vec3::UnitY(),
                    .origin_b = {slips ? kSlide : 0.0, 0, kDepth},
                    .e1_b = Vec3::UnitX(),
                    .e2_b = Vec3::UnitY()});
        corners.grow(kXi.size() * kRow);
        for (std::size_t k = 0; k < kXi.size(); ++k) {
            corners.set(k * kRow, 0, kXi[k]);
            corners.set(k * kRow, 1, kEta[k]);
        }
        return {.position = z,
                .orientation = orientation.data(),
                .velocity = none,
                .angular_velocity = none,
                .groups = &group,
                .block_a = index.data(),
                .block_b = index.data(),
                .joint = index.data(),
                .frames = frames.data(),
                .corners = corners.data(),
                .patch_area = o,
                .laws = &law,
                .point_places = o,
                .memory = memory.data(),
                .wrenches = wrenches.data(),
                .remembers = false,
                .curved = false,
                .keeps_energy = false,
                .beyond_caches = false,
                .release = 1,
                .contact_damping = 0,
                .restitution = false,
                .places = placesOf(rule),
                .distributed = rule.kind == PointRule::Kind::distributed};
    }
};

}  // namespace

int pointsPerRectangle(PointRule rule) {
    switch (rule.kind) {
        case PointRule::Kind::vertex:
        case PointRule::Kind::distributed:
            return 9;
        case PointRule::Kind::corner:
        case PointRule::Kind::quarter:
            return 4;
        case PointRule::Kind::grid:
            return rule.grid * rule.grid;
    }
    return 0;
}

std::string nameOf(PointRule rule) {
    switch (rule.kind) {
        case PointRule::Kind::vertex:
            return "vertex";
        case PointRule::Kind::distributed:
            return "distributed";
        case PointRule::Kind::corner:
            return "corner";
        case PointRule::Kind::quarter:
            return "quarter";
        case PointRule::Kind::grid:
            return "grid" + std::to_string(rule.grid);
    }
    return {};
}

// A rectangle with `vertex`, all stick: 659 flops, 63 choices; read 408 bytes, written 216.
// bench/studies/contact-kernel.md has the table. Beside what the kernel loads member by member: two blocks
// and a joint (3 x 4 bytes), and the interface's eighth of its group (32 bytes).
Counts countInterface(PointRule rule, bool slips) {
    OneInterface data;
    data.group = {.begin = 0, .size = 1, .corners = 4, .points = pointsPerRectangle(rule)};
    const ContactView view = data.view(rule, slips);
    tally = {};
    updateGroups<Counting>(view, 0, 1);
    tally.read += 3 * sizeof(std::int32_t) + sizeof(InterfaceGroup) / static_cast<double>(simd::kLanes);
    return tally;
}

namespace {

/// What a kernel of motion_kernel.h does to one block.
template <class Kernel>
Counts countMotion() {
    std::vector<double> zero(1, 0.0), out(1, 0.0), position(4, 0.0), orientation{1, 0, 0, 0};
    const std::uint8_t free = 1;
    const Vectors to{out.data(), out.data(), out.data()};
    const MotionView view{.interface_begin = nullptr,
                          .mass = zero.data(),
                          .inverse_mass = zero.data(),
                          .free = &free,
                          .inverse_inertia = {zero.data(), zero.data(), zero.data()},
                          .wrench = nullptr,
                          .wrenches = nullptr,
                          .position = position.data(),
                          .orientation = orientation.data(),
                          .velocity = to,
                          .angular_momentum = to,
                          .force = to,
                          .torque = to,
                          .angular_velocity = to,
                          .gravity = {},
                          .time_step = 1e-3,
                          .decay = 1,
                          .spin_decay = 1,
                          .local_damping = 0.1};
    tally = {};
    Kernel::template on<Counting>(view, Consecutive<Counting>{0});
    return tally;
}

/// motion.cpp's sum of wrenches, by hand, and a kernel on the blocks. Per side of an interface: place of its
/// wrench 4; force and moment are three additions each. Per interface: force, moment_a, moment_b, 9 doubles.
/// Per block: its row in the incidence list 2 x 8, and what the kernel reads and writes, where nothing that
/// is still in the cache counts.
template <class Kernel>
Counts countGatherWith(double doubles_read, double doubles_written) {
    constexpr double kSides = 6, kInterfaces = 3;
    Counts counts = countMotion<Kernel>();
    counts.flops += kSides * 6 + 3;
    counts.read = kSides * 4 + kInterfaces * 72 + 2 * 8 + 1 + doubles_read * 8;
    counts.written = doubles_written * 8;
    return counts;
}

}  // namespace

Counts countDrift() { return countMotion<Drift>(); }

// Read: mass, inverse mass, velocity, angular momentum, angular velocity. Written: force, torque, velocity,
// momentum.
Counts countGather() { return countGatherWith<Kick>(11, 12); }

// Read: the same, inverse inertia, pose of eight. Written: the same, angular velocity, pose.
Counts countGatherAndDrift() { return countGatherWith<KickAndDrift>(22, 23); }

}  // namespace talus::bench
