// Where the bolts of a pattern go: a grid on the plane of a face, each head where the grid's normal first
// meets the rock.

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/box_clip.h"
#include "geometry/parts.h"
#include "talus/bolts.h"

namespace talus {
namespace {

constexpr double kLooks = 0.5 - 1e-9;  // cosine of 60 degrees: largest angle between a face's normal and the
                                       // pattern's direction
constexpr double kMostBolts = 100'000;
constexpr double kOff = 1e-5;  // of a face's extent: a face is free if no other block is within this distance

/// Part of a face in the pattern's box.
struct Part {
    FaceFrame face;
    Polygon outline;
};

bool contains(const Polygon& polygon, const Vec2& p) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 edge = polygon.next(i) - polygon[i], to = p - polygon[i];
        if (edge.x() * to.y() - edge.y() * to.x() < 0) return false;
    }
    return !polygon.empty();
}

class Placing {
 public:
    Placing(const BoltPattern& pattern, const Model& model) : pattern_(pattern), model_(model) {}

    std::optional<PatternExtent> facesExtent() {
        findParts();
        if (parts_.empty()) return std::nullopt;
        findPlane();
        const auto reach = [&](const Vec3& axis) {
            const auto [low, high] = extentOn(axis);
            return high - low;
        };
        return PatternExtent{reach(along_), reach(up_)};
    }

    /// Adds the bolts to `bolts`. Returns what is wrong, or nothing.
    std::optional<Error> run(std::vector<Bolt>& bolts) {
        findParts();
        if (parts_.empty()) return noFace();
        findPlane();
        const double count = countOn(along_, pattern_.spacing_along) * countOn(up_, pattern_.spacing_up);
        if (count > kMostBolts)
            return Error{pattern_.like.field + ".spacing", "found one that gives " + std::to_string(count) +
                                                               " bolts, allowed: at most " +
                                                               std::to_string(static_cast<int>(kMostBolts))};
        const std::vector<double> along = line(along_, pattern_.spacing_along);
        const std::size_t before = bolts.size();
        for (const double v : line(up_, pattern_.spacing_up))
            for (const double u : along)
                if (const auto head = headAt(u, v)) bolts.push_back(boltAt(*head, bolts.size() - before + 1));
        return bolts.size() > before ? std::nullopt : std::optional(noFace());
    }

 private:
    Error noFace() const {
        return {pattern_.like.field + ".box",
                "found no free face in the box with a normal within 60 degrees of `face`; allowed: a box "
                "with at least a part of one"};
    }

    void findParts() {
        for (const Block& block : model_.blocks)
            for (std::size_t f = 0; f < block.shape.faces.size(); ++f) {
                const FaceFrame face = faceFrame(block.shape, f);
                if (face.e3.dot(pattern_.direction) < kLooks) continue;
                const Polygon whole = outlineOf(block.shape, f);
                const double slack = kOff * extent(whole);
                Polygon part = clippedToBox(whole, face, pattern_.box_min, pattern_.box_max, slack);
                if (!part.empty() && isFree(face.toWorld(centroid(part)), face.e3, slack))
                    parts_.push_back({face, std::move(part)});
            }
    }

    bool isFree(const Vec3& place, const Vec3& normal, double off) const {
        const Vec3 outside = place + off * normal;
        const auto covers = [&](const Polyhedron& part) {
            for (std::size_t f = 0; f < part.faces.size(); ++f) {
                const Vec3& corner = part.vertices[static_cast<std::size_t>(part.faces[f][0])];
                if (part.faceNormal(f).dot(outside - corner) > 0) return false;
            }
            return true;
        };
        return std::none_of(model_.blocks.begin(), model_.blocks.end(), [&](const Block& block) {
            const std::vector<Polyhedron> parts = partsOf(block.shape);
            return std::any_of(parts.begin(), parts.end(), covers);
        });
    }

    /// The faces' mean plane; along it is level.
    void findPlane() {
        normal_ = Vec3::Zero();
        for (const Part& part : parts_) normal_ += area(part.outline) * part.face.e3;
        normal_.normalize();
        along_ = Vec3::UnitZ().cross(normal_);
        along_ = along_.norm() > 1e-6 ? along_.normalized() : Vec3(Vec3::UnitY());
        up_ = normal_.cross(along_).normalized();
        along_ = up_.cross(normal_);
    }

    /// Extent of the faces along an axis [m].
    std::pair<double, double> extentOn(const Vec3& axis) const {
        double low = kInfinity, high = -kInfinity;
        for (const Part& part : parts_)
            for (const Vec2& v : part.outline) {
                const double at = axis.dot(part.face.toWorld(v));
                low = std::min(low, at);
                high = std::max(high, at);
            }
        return {low, high};
    }

    double countOn(const Vec3& axis, double spacing) const {
        const auto [low, high] = extentOn(axis);
        return std::max(1.0, std::floor((high - low) / spacing + 1e-9));
    }

    /// Places along an axis of the plane, in the middle of fields as wide as the spacing.
    std::vector<double> line(const Vec3& axis, double spacing) const {
        const auto [low, high] = extentOn(axis);
        const double count = countOn(axis, spacing);
        std::vector<double> places;
        for (double k = 0; k < count; ++k)
            places.push_back(0.5 * (low + high) + (k - 0.5 * (count - 1)) * spacing);
        return places;
    }

    /// The outermost place on the faces over a place of the plane.
    std::optional<Vec3> headAt(double along, double up) const {
        const Vec3 foot = along * along_ + up * up_;
        double farthest = -kInfinity;
        const Part* on = nullptr;
        for (const Part& part : parts_) {
            const double towards = part.face.e3.dot(normal_);
            if (towards < 1e-6) continue;
            const double out = part.face.e3.dot(part.face.origin - foot) / towards;
            if (out > farthest && contains(part.outline, part.face.toPlane(foot + out * normal_)))
                farthest = out, on = &part;
        }
        if (on == nullptr) return std::nullopt;
        const Vec3 head = foot + farthest * normal_;
        if (!isFree(head, on->face.e3, kOff * extent(on->outline))) return std::nullopt;
        return head;
    }

    Bolt boltAt(const Vec3& head, std::size_t number) const {
        Bolt bolt = pattern_.like;
        const double level = std::cos(pattern_.plunge);
        bolt.head = head;
        bolt.end =
            head + pattern_.length * Vec3(level * std::sin(pattern_.trend), level * std::cos(pattern_.trend),
                                          -std::sin(pattern_.plunge));
        bolt.name += "-" + std::to_string(number);
        bolt.must_hold = false;
        return bolt;
    }

    const BoltPattern& pattern_;
    const Model& model_;
    std::vector<Part> parts_{};
    Vec3 normal_ = Vec3::UnitZ(), along_ = Vec3::UnitX(), up_ = Vec3::UnitY();
};

}  // namespace

std::vector<Error> placeBoltPatterns(Model& model) {
    std::erase_if(model.bolts, [&](const Bolt& bolt) {
        return std::any_of(model.bolt_patterns.begin(), model.bolt_patterns.end(),
                           [&](const BoltPattern& pattern) { return pattern.like.field == bolt.field; });
    });
    std::vector<Error> errors;
    for (const BoltPattern& pattern : model.bolt_patterns)
        if (auto error = Placing(pattern, model).run(model.bolts)) errors.push_back(std::move(*error));
    return errors;
}

std::optional<PatternExtent> extentOf(const BoltPattern& pattern, const Model& model) {
    return Placing(pattern, model).facesExtent();
}

}  // namespace talus
