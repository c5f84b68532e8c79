#include "block_theory/toppling_columns.h"

#include <algorithm>

namespace talus::keyblocks {
namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Force on the column in front per unit of normal force: it pushes, and friction drags the column down.
Vec2 pushOf(const SideFace& face, double factor) {
    return face.normal - face.tan_friction / factor * face.along;
}

/// Shear along the base that its friction does not carry [N].
double sliding(const LeaningColumn& column, const Vec2& force, double factor) {
    return force.dot(column.downhill) + column.tan_friction / factor * force.dot(column.base_normal);
}

/// The least push that carries an excess; nothing where pushing carries none of it.
std::optional<double> least(double excess, double carried_by_unit) {
    if (excess <= 0) return 0.0;
    if (!(carried_by_unit > 0)) return std::nullopt;
    return excess / carried_by_unit;
}

}  // namespace

double turning(const LeaningColumn& column, const Vec2& arm, const Vec2& force) {
    return cross(column.base_normal, column.downhill) > 0 ? cross(arm, force) : -cross(arm, force);
}

namespace {

/// Forces on a column but those of its base and of the next column downhill.
struct Loads {
    Vec2 force;         ///< [N]
    double moment = 0;  ///< about the pivot [N m]
};

/// What a column passes on.
struct Push {
    double normal = 0;  ///< [N]
    Vec2 at;            ///< [m]
    bool by_toppling = false;
};

Loads loadsOn(const LeaningColumn& column, const SideFace* behind, const Push& push, double factor) {
    Loads loads{column.force, column.moment};
    if (push.normal <= 0) return loads;
    const Vec2 force = push.normal * pushOf(*behind, factor);
    loads.force += force;
    loads.moment += turning(column, push.at - column.pivot, force);
    return loads;
}

/// The push itself, and the lowest place at which the column does not topple.
std::optional<Push> pushFrom(const LeaningColumn& column, const Loads& loads, double factor) {
    const SideFace& face = *column.front;
    const Vec2 by_unit = pushOf(face, factor);
    const double at_top = turning(column, face.top - column.pivot, by_unit),
                 at_bottom = turning(column, face.bottom - column.pivot, by_unit);
    const auto by_moment = least(loads.moment, at_top);
    const auto by_slide = least(sliding(column, loads.force, factor), sliding(column, by_unit, factor));
    if (!by_moment || !by_slide) return std::nullopt;
    Push push{std::max(*by_moment, *by_slide), face.top, *by_moment > *by_slide};
    if (push.by_toppling || push.normal == 0) return push;
    const double needed = loads.moment / push.normal;
    const double share = at_top > at_bottom ? (needed - at_bottom) / (at_top - at_bottom) : 1.0;
    push.at = face.bottom + std::clamp(share, 0.0, 1.0) * (face.top - face.bottom);
    return push;
}

/// Whether the base bears these loads: it presses, and not beyond its uphill end. Its downhill end is the
/// pivot, beyond which the column topples.
bool bears(const LeaningColumn& column, const Loads& loads) {
    const double normal = -loads.force.dot(column.base_normal);
    return normal > 0 && -loads.moment <= normal * column.base_length;
}

}  // namespace

std::optional<LeaningState> leaningAt(std::span<const LeaningColumn> columns, double factor) {
    LeaningState state;
    Push push;
    for (std::size_t k = columns.size(); k-- > 0;) {
        const LeaningColumn& column = columns[k];
        if (push.normal <= 0) state.moving = 0, state.topples = false;
        Loads loads = loadsOn(column, push.normal > 0 ? &*columns[k + 1].front : nullptr, push, factor);
        ++state.moving;
        if (!column.front) {
            if (!bears(column, loads)) return std::nullopt;
            const double topples = loads.moment / column.arm, slides = sliding(column, loads.force, factor);
            state.excess = std::max(topples, slides) / column.force.norm();
            state.topples = state.topples || topples > slides;
            break;
        }
        const auto passed = pushFrom(column, loads, factor);
        if (!passed) return std::nullopt;
        push = *passed;
        state.topples = state.topples || push.by_toppling;
        const Vec2 back = -push.normal * pushOf(*column.front, factor);
        loads.force += back;
        loads.moment += turning(column, push.at - column.pivot, back);
        if (!bears(column, loads)) return std::nullopt;
    }
    return state;
}

}  // namespace talus::keyblocks
