#pragma once
// Loads: forces at points of blocks, pressures on whole faces, and pressures on free face area inside a box.
// They keep the direction they have at the start and follow their point, so they are dead forces with a
// potential.
//
// Reads:  the model's loads; at the start shapes, poses and interfaces; then load.time, load.gravity_share,
//         orientations
// Writes: its parts, at the build

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "forces/contact_forces.h"
#include "forces/wrench.h"
#include "geometry/box_clip.h"
#include "geometry/face_frame.h"
#include "geometry/parts.h"
#include "model/over_time.h"
#include "state/arrays.h"
#include "state/point_layout.h"
#include "talus/result.h"

namespace talus::loads {

inline constexpr double kLooks = 0.5 - 1e-9;  // cosine of 60 degrees: largest angle between a face's normal
                                              // and the load's direction
inline constexpr double kClosed = 1e-6;       // of the length scale: a wider joint leaves its faces free
inline constexpr double kLeastFree = 1e-9;    // share of a face that counts
inline constexpr double kInReach = 1e-3;      // of the block's size: a point that far outside is on it

/// Numbers of a part: the force [N] and the arms [N m], row by row, at a factor of 1.
inline constexpr std::size_t kNumbers = 12;

/// Part of a face: its area [m^2] and first moments in the face's plane [m^3].
struct Region {
    double area = 0;
    Vec2 moment = Vec2::Zero();

    void add(const Polygon& polygon, double sign) {
        if (polygon.empty()) return;
        const double own = sign * talus::area(polygon);
        area += own;
        moment += own * centroid(polygon);
    }
};

/// One face of a block in the model's frame at the start.
class Face {
 public:
    Face(const State& state, std::size_t block, std::size_t face)
        : state_(state),
          block_(block),
          face_(face),
          own_(faceFrame(state.geometry->shape[block], face)),
          turn_(state.geometry->initial_orientation.matrix(block)),
          origin_(state.geometry->origin + state.geometry->initial_position.get(block) +
                  turn_ * own_.origin) {}

    Vec3 normal() const { return turn_ * own_.e3; }

    Polygon outline() const { return outlineOf(state_.geometry->shape[block_], face_); }

    /// Less what lies on other parts of the block.
    Region whole() const {
        Region region;
        region.add(outline(), 1.0);
        for (const Polygon& cover : covers()) region.add(cover, -1.0);
        return region;
    }

    /// The area in the box and under no closed joint. Joints of one face do not overlap, so each is
    /// subtracted alone.
    Region freeIn(const AppliedLoad& load) const {
        Region region;
        region.add(clipped(outline(), load), 1.0);
        for (const Polygon& cover : covers()) region.add(clipped(cover, load), -1.0);
        const Incidence& incidence = state_.incidence;
        for (auto k = incidence.interface_begin[block_]; k < incidence.interface_begin[block_ + 1]; ++k) {
            const auto i = static_cast<std::size_t>(incidence.interface[static_cast<std::size_t>(k)]);
            if (covers(i, incidence.isB(k))) region.add(clipped(patch(i, incidence.isB(k)), load), -1.0);
        }
        if (region.area <= kLeastFree * talus::area(outline())) return {};
        return region;
    }

    /// A pressure on it, about the block's centroid.
    DeadForce pushed(const Region& region, double pressure) const {
        const Vec3 push = -pressure * normal();
        const Vec3 arm =
            region.area * own_.origin + region.moment.x() * own_.e1 + region.moment.y() * own_.e2;
        return {region.area * push, arm * push.transpose()};
    }

 private:
    std::vector<Polygon> covers() const { return coversOf(state_.geometry->shape[block_], face_); }

    bool covers(std::size_t i, bool is_b) const {
        const Interfaces& f = state_.interfaces;
        const auto face = static_cast<std::size_t>(is_b ? f.face_b[i] : f.face_a[i]);
        return f.kind[i] == InterfaceKind::faces && face == face_ &&
               relativePose(state_, i).gap.x() <= kClosed * state_.geometry->length_scale;
    }

    Polygon patch(std::size_t i, bool is_b) const {
        const InterfaceFrame frame = state_.interfaces.frame(i);
        const Vec3 origin = is_b ? frame.origin_b : frame.origin_a, e1 = is_b ? frame.e1_b : frame.e1_a,
                   e2 = is_b ? frame.e2_b : frame.e2_a;
        std::vector<Vec2> corners = patchOutline(state_.interfaces, i);
        if (is_b) std::reverse(corners.begin(), corners.end());  // its normal is opposite to the patch's
        Polygon polygon;
        for (const Vec2& v : corners) polygon.push(own_.toPlane(origin + v.x() * e1 + v.y() * e2));
        return polygon;
    }

    /// The part of a polygon of this face in a load's box.
    Polygon clipped(Polygon polygon, const AppliedLoad& load) const {
        const FaceFrame in_model{origin_, turn_ * own_.e1, turn_ * own_.e2, normal()};
        return clippedToBox(std::move(polygon), in_model, load.box_min, load.box_max,
                            kClosed * state_.geometry->length_scale);
    }

    const State& state_;
    std::size_t block_, face_;
    FaceFrame own_;
    Mat3 turn_;
    Vec3 origin_;  ///< of the face's plane, in the model [m]
};

/// Wrench of one load on one block.
struct Part {
    std::int32_t block, source;
    DeadForce force;
};

/// Collects the parts of all loads of a model.
class Build {
 public:
    explicit Build(State& state) : state_(state), model_(state.geometry->model) {}

    std::vector<Error> parts(ForceParts& into) {
        for (std::size_t k = 0; k < model_.loads.size(); ++k) add(static_cast<std::int32_t>(k));
        std::stable_sort(parts_.begin(), parts_.end(),
                         [](const Part& a, const Part& b) { return a.block < b.block; });
        for (const Part& part : parts_) store(part, into);
        into.begin.push_back(into.source.size());
        return std::move(errors_);
    }

 private:
    void add(std::int32_t index) {
        const AppliedLoad& load = model_.loads[static_cast<std::size_t>(index)];
        const auto block = static_cast<std::size_t>(load.block);
        if (load.kind == AppliedLoad::Kind::box) return addBox(load, index);
        if (state_.blocks.motion[block] != Motion::free) {
            errors_.push_back(
                {load.field + ".block", "found \"" + model_.blocks[block].name +
                                            "\", which does not move freely; allowed: a free block"});
            return;
        }
        const bool at_point = load.kind == AppliedLoad::Kind::force;
        parts_.push_back({load.block, index, at_point ? atPoint(load, block) : onFace(load, block)});
    }

    DeadForce atPoint(const AppliedLoad& load, std::size_t block) {
        if (!load.point) return {load.force, Mat3::Zero()};
        const Geometry& geometry = *state_.geometry;
        const Vec3 arm = geometry.initial_orientation.matrix(block).transpose() *
                         (*load.point - geometry.origin - geometry.initial_position.get(block));
        if (!contains(geometry.shape[block], arm, kInReach * geometry.size[block]))
            state_.warnings.push_back(load.field + ": its point lies outside block \"" +
                                      model_.blocks[block].name + "\" but moves with that block");
        return {load.force, arm * load.force.transpose()};
    }

    DeadForce onFace(const AppliedLoad& load, std::size_t block) {
        DeadForce sum;
        for (const std::int32_t f : sideTowards(model_.blocks[block].shape, load.direction)) {
            const Face face(state_, block, static_cast<std::size_t>(f));
            sum += face.pushed(face.whole(), load.pressure);
        }
        return sum;
    }

    void addBox(const AppliedLoad& load, std::int32_t index) {
        const std::size_t before = parts_.size();
        for (std::size_t b = 0; b < state_.blocks.size(); ++b) {
            if (state_.blocks.motion[b] != Motion::free) continue;
            for (std::size_t f = 0; f < state_.geometry->shape[b].faces.size(); ++f) {
                if (state_.geometry->shape[b].isInner(f)) continue;
                const Face face(state_, b, f);
                if (face.normal().dot(load.direction) < kLooks) continue;
                const Region region = face.freeIn(load);
                if (region.area > 0)
                    parts_.push_back(
                        {static_cast<std::int32_t>(b), index, face.pushed(region, load.pressure)});
            }
        }
        if (parts_.size() == before && !model_.is_remainder)
            errors_.push_back({load.field + ".box",
                               "found no free face of a free block in the box with a normal within 60 "
                               "degrees of `face`; allowed: a box with at least a part of one"});
    }

    static void store(const Part& part, ForceParts& into) {
        if (into.block.empty() || into.block.back() != part.block) {
            into.block.push_back(part.block);
            into.begin.push_back(into.source.size());
        }
        into.source.push_back(part.source);
        for (const double number : part.force.force) into.numbers.push_back(number);
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column) into.numbers.push_back(part.force.arms(row, column));
    }

    State& state_;
    const Model& model_;
    std::vector<Part> parts_{};
    std::vector<Error> errors_{};
};

/// Errors: a load on a block that is not free, a box without a face.
inline std::vector<Error> build(State& state, ForceParts& parts) { return Build(state).parts(parts); }

inline std::span<const std::int32_t> blocks(const State&, const ForceParts& parts) { return parts.block; }

/// As the load has it now.
inline DeadForce dead(const State& state, const ForceParts& parts, std::size_t block) {
    const auto at =
        std::lower_bound(parts.block.begin(), parts.block.end(), static_cast<std::int32_t>(block));
    DeadForce sum;
    if (at == parts.block.end() || static_cast<std::size_t>(*at) != block) return sum;
    const auto row = static_cast<std::size_t>(at - parts.block.begin());
    for (std::size_t p = parts.begin[row]; p < parts.begin[row + 1]; ++p) {
        const AppliedLoad& load = state.geometry->model.loads[static_cast<std::size_t>(parts.source[p])];
        const double factor = state.load.gravity_share * factorAt(load, state.load.time);
        const double* numbers = parts.numbers.data() + kNumbers * p;
        sum.force += factor * Eigen::Map<const Vec3>(numbers);
        sum.arms += factor * Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(numbers + 3);
    }
    return sum;
}

inline Wrench on(const State& state, const ForceParts& parts, std::size_t block) {
    if (parts.block.empty()) return {};
    return dead(state, parts, block).at(state.blocks.orientation.matrix(block));
}

}  // namespace talus::loads
