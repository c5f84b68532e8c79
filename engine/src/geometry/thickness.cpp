#include "geometry/thickness.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus {
namespace {

constexpr double kNeverMeets = 1e-12;  // of a unit vector along a normal: the line never meets the plane

/// What of a line a convex part holds [m]; empty when begin > end.
struct Held {
    double begin = -std::numeric_limits<double>::infinity(), end = -begin;
};

Held heldBy(std::span<const FacePlane> part, const Vec3& from, const Vec3& direction, double tolerance) {
    Held held;
    for (const FacePlane& face : part) {
        const double below = tolerance - face.normal.dot(from - face.at), along = face.normal.dot(direction);
        if (std::abs(along) < kNeverMeets) {
            if (below < 0) return {1, 0};
        } else if (along > 0) {
            held.end = std::min(held.end, below / along);
        } else {
            held.begin = std::max(held.begin, below / along);
        }
    }
    return held;
}

}  // namespace

double thicknessAt(const PartOfBody& body, const Vec3& surface, const Vec3& inwards, double enough) {
    const Vec3 from = body.turn.transpose() * (surface - body.position),
               direction = body.turn.transpose() * inwards;
    const auto& parts = body.shape.faces.parts();
    const auto held = [&](std::size_t part) {
        const auto first = static_cast<std::size_t>(parts[part].first_face);
        return heldBy(body.planes.subspan(first, parts[part].faces.size()), from, direction, body.tolerance);
    };
    double reached = 0;
    std::size_t part = body.part, farthest = part;
    const auto look = [&](std::size_t candidate) {
        const Held here = held(candidate);
        if (here.begin > here.end || here.begin > reached + body.tolerance) return;
        if (here.end > reached + body.tolerance) reached = here.end, farthest = candidate;
    };
    look(part);
    // Each part is left where the line goes on the farthest, until none goes on.
    for (bool goes_on = true; goes_on && reached < enough;) {
        const double before = reached;
        part = farthest;
        for (const std::int32_t beside : parts[part].beside) look(static_cast<std::size_t>(beside));
        goes_on = reached > before;
    }
    return reached > 2 * body.tolerance ? reached : 0.0;
}

}  // namespace talus
