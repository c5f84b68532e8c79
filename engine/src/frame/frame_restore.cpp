// A full frame put in place of the state. Frames come from files, and files may hold anything: every index is
// checked before it is used.

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "forces/sum.h"
#include "forces/water.h"
#include "forces/wet_walls.h"
#include "frame/frame.h"
#include "frame/frame_fields.h"
#include "frame/vertex_edge_fields.h"
#include "law/joint_laws.h"
#include "law/points.h"
#include "measure/measure.h"
#include "state/block_motion.h"
#include "state/incidence.h"
#include "state/point_layout.h"
#include "talus/frame_table.h"
#include "validate/validate.h"

namespace talus {
namespace {

/// Copies an array of the frame into the state.
struct FromFrame {
    void operator()(VectorArray& s, const VectorList<double>& f) const { s.x = f.x, s.y = f.y, s.z = f.z; }
    void operator()(PositionArray& s, const VectorList<double>& f) const {
        s.clear();
        for (std::size_t i = 0; i < f.x.size(); ++i) s.push_back({f.x[i], f.y[i], f.z[i]});
    }
    void operator()(QuaternionArray& s, const QuaternionList& f) const {
        s.clear();
        for (std::size_t i = 0; i < f.w.size(); ++i) s.push_back({f.w[i], f.x[i], f.y[i], f.z[i]});
    }
    template <class A, class B>
    void operator()(std::vector<A>& s, const std::vector<B>& f) const {
        s.assign(f.begin(), f.end());
    }
    template <class A, class B>
    std::enable_if_t<std::is_arithmetic_v<A>> operator()(A& s, const B& f) const {
        s = static_cast<A>(f);
    }
};

/// Whether every number of a frame is one.
struct AllFinite {
    bool* finite;

    void operator()(const std::vector<double>& values) const {
        for (const double value : values) *finite = *finite && std::isfinite(value);
    }
    void operator()(const VectorList<double>& f) const { (*this)(f.x), (*this)(f.y), (*this)(f.z); }
    void operator()(const QuaternionList& f) const { (*this)(f.w), (*this)(f.x), (*this)(f.y), (*this)(f.z); }
    template <class B>
    void operator()(const std::vector<B>&) const {}  // readings, indices and flags
    template <class S, class B>
    void operator()(const S&, const B& f) const {
        if constexpr (std::is_floating_point_v<B>) *finite = *finite && std::isfinite(f);
    }
};

bool isFinite(const FullFrame& frame) {
    bool finite = true;
    eachFrameArray(frame, [&](std::string_view, const auto& field, const auto& array) {
        if (!field.traits.any_number) AllFinite{&finite}(array);
    });
    const State state{};
    eachScalar(state, frame, AllFinite{&finite});
    return finite;
}

bool facesFit(const FrameInterfaces& f, const State& state) {
    const auto& shapes = state.geometry->shape;
    const auto isFace = [&](std::int32_t block, std::int32_t face) {
        return face >= 0 &&
               static_cast<std::size_t>(face) < shapes[static_cast<std::size_t>(block)].faces.size();
    };
    for (std::size_t i = 0; i < f.size(); ++i)
        if (f.block_a[i] == f.block_b[i] || !(f.area[i] > 0) || !isFace(f.block_a[i], f.face_a[i]) ||
            !isFace(f.block_b[i], f.face_b[i]))
            return false;
    return true;
}

std::vector<Eigen::Vector2d> outlineOf(const FrameInterfaces& f, std::size_t i) {
    std::vector<Eigen::Vector2d> outline;
    for (auto v = static_cast<std::size_t>(f.patch_begin[i]);
         v < static_cast<std::size_t>(f.patch_begin[i + 1]); ++v)
        outline.emplace_back(f.patch_xi[v], f.patch_eta[v]);
    return outline;
}

/// contact points as many as the rule gives on each patch.
bool pointsFit(const FullFrame& frame, const PointRule& rule, bool dilates) {
    const FramePoints& f = frame.points;
    for (const double area : f.area)
        if (!(area > 0)) return false;
    if (f.dilation.size() != (dilates ? f.size() : 0)) return false;
    for (std::size_t i = 0; i < frame.interfaces.size(); ++i) {
        const std::vector<Eigen::Vector2d> outline = outlineOf(frame.interfaces, i);
        if (outline.size() == 2 || frame.interfaces.point_begin[i + 1] - frame.interfaces.point_begin[i] !=
                                       static_cast<std::int64_t>(contact::pointCount(outline, rule)))
            return false;
    }
    return true;
}

/// Walls that are polygons, sorted by water.
bool wetFits(const FrameWetPatches& f) {
    for (std::size_t w = 0; w < f.block.size(); ++w) {
        Polygon wall;
        for (auto v = static_cast<std::size_t>(f.vertex_begin[w]);
             v < static_cast<std::size_t>(f.vertex_begin[w + 1]); ++v)
            wall.push({f.vertex_x[v], f.vertex_y[v]});
        if (!(area(wall) > 0)) return false;
    }
    for (std::size_t water = 0; water + 1 < f.water_begin.size(); ++water)
        for (auto w = f.water_begin[water]; w < f.water_begin[water + 1]; ++w)
            if (f.water[static_cast<std::size_t>(w)] != static_cast<std::int32_t>(water)) return false;
    return true;
}

/// Patches and contact points in the layout of the kernel, which follows from their order.
void restorePatches(const FullFrame& frame, State& state) {
    const FrameInterfaces& f = frame.interfaces;
    Interfaces& interfaces = state.interfaces;
    interfaces.groups.clear();
    interfaces.slot.clear();
    interfaces.frames = LaneArray(kFrameQuantities);
    interfaces.corners = LaneArray(kCornerQuantities);
    interfaces.wrenches.clear();
    for (std::size_t i = 0; i < f.size(); ++i) {
        const std::vector<Eigen::Vector2d> outline = outlineOf(f, i);
        addToGroups(interfaces, outline.size(),
                    static_cast<std::size_t>(f.point_begin[i + 1] - f.point_begin[i]));
        placeCorners(interfaces, i, outline);
        InterfaceFrame kept;
        eachFrameVector(f, [&](auto vector, const VectorList<double>& list) {
            kept.*vector = {list.x[i], list.y[i], list.z[i]};
        });
        interfaces.setFrame(i, kept);
        InterfaceWrench wrench;
        eachWrenchVector(f, [&](auto vector, const VectorList<double>& list) {
            wrench.*vector = {list.x[i], list.y[i], list.z[i]};
        });
        interfaces.setWrench(i, wrench);
    }
    restorePlaces(interfaces);
    makePoints(state);
    ContactPoints& points = state.points;
    for (std::size_t i = 0; i < f.size(); ++i)
        for (std::size_t k = 0; k < interfaces.pointCount(i); ++k) {
            const std::size_t p = static_cast<std::size_t>(f.point_begin[i]) + k;
            contact::PointMemory memory{.offset_1 = frame.points.offset_1[p],
                                        .offset_2 = frame.points.offset_2[p],
                                        .bond = frame.points.bond[p]};
            if (!frame.points.dilation.empty()) memory.dilation = frame.points.dilation[p];
            points.setMemory(interfaces.pointSlot(i, k), memory);
        }
}

void restoreWaters(const FrameWaters& f, State& state) {
    const std::size_t n = f.p0.size();
    state.pressure.resize(n);
    state.water_load.resize(n);
    for (std::size_t w = 0; w < n; ++w) {
        state.pressure[w] = {f.p0[w], Vec3(f.gradient.x[w], f.gradient.y[w], f.gradient.z[w])};
        state.water_load[w] = {f.tilt[w], f.share[w], f.level[w], f.load_drained[w] != 0};
    }
}

}  // namespace

std::uint64_t hashOf(const FullFrame& frame) {
    State state;
    eachBlockField(state.blocks, frame.blocks, FromFrame{});
    const FramePoints& f = frame.points;
    const auto valueAt = [](const std::vector<double>& values, std::size_t point) {
        return point < values.size() ? values[point] : 0.0;
    };
    return stateHash(state.blocks, [&](const auto& add) {
        for (std::size_t p = 0; p < f.size(); ++p)
            add({valueAt(f.normal, p), valueAt(f.shear_1, p), valueAt(f.shear_2, p), valueAt(f.offset_1, p),
                 valueAt(f.offset_2, p), valueAt(f.bond, p)});
    });
}

namespace {

/// A parameter that the frame does not have, because it is older, is the model's.
void restoreLaws(const FrameLaws& frame, const std::vector<Joint>& joints,
                 std::vector<contact::JointLaw>& laws) {
    for (const auto& parameter : contact::kLawParameters<double>)
        if (const std::vector<double>* values = frame.find(parameter.name))
            for (std::size_t joint = 0; joint < laws.size(); ++joint)
                laws[joint].*parameter.value = (*values)[joint];
    for (std::size_t joint = 0; joint < laws.size(); ++joint) laws[joint].bonded = frame.bonded[joint] != 0;
    for (std::size_t joint = 0; joint < laws.size(); ++joint) setRest(joints[joint], laws[joint]);
}

Error misfitError(const std::string& field) {
    return {field,
            "the full frame does not fit its scenario or is damaged; allowed: a frame of the same model"};
}

}  // namespace

std::vector<Error> takeFrame(const FullFrame& frame, State& state) {
    const FrameCounts counts{state.blocks.size(), state.geometry->model.waters.size(), state.laws.size()};
    if (const auto field = misfit(frame, counts)) return {misfitError("full." + *field)};
    if (!isFinite(frame) || !(frame.loads.release > 0) || !(frame.search_margin > 0))
        return {misfitError("full")};
    restoreLaws(frame.laws, state.geometry->model.joints, state.laws);
    const bool dilates = std::any_of(state.laws.begin(), state.laws.end(), contact::dilates);
    if (!facesFit(frame.interfaces, state) || !placesFit(frame.interfaces))
        return {misfitError("full.interfaces")};
    if (!pointsFit(frame, state.geometry->model.points, dilates)) return {misfitError("full.points")};
    if (!wetFits(frame.wet)) return {misfitError("full.wet")};
    if (!isForceMemory(state, frame.memory)) return {misfitError("full.memory")};

    eachField(state, frame, FromFrame{});
    restorePatches(frame, state);
    restoreWaters(frame.waters, state);
    setForceMemory(state, frame.memory);
    updateSpin(state, {0, state.blocks.size()});
    buildIncidence(state);
    finishWalls(state);
    boundPressures(state);
    return {};
}

std::vector<Error> restoreFrame(const FullFrame& frame, State& state) {
    if (std::vector<Error> errors = takeFrame(frame, state); !errors.empty()) return errors;
    if (stateHash(state) != frame.state_hash)
        return {{"full.state_hash", "is not the hash of the frame's own values: the frame is damaged"}};
    if (const std::vector<std::string> findings = validate(state); !findings.empty())
        return {{"full", findings.front() + "; allowed: a frame as a run writes it"}};
    return {};
}

}  // namespace talus
