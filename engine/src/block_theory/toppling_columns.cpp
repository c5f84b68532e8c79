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

std::optional<LeaningState> leaningAt(std::span<const LeaningColumn> columns, double factor) {
    LeaningState state;
    double push = 0;
    for (std::size_t k = columns.size(); k-- > 0;) {
        const LeaningColumn& column = columns[k];
        Vec2 force = column.force;
        double moment = column.moment;
        if (push > 0) {
            const SideFace& behind = *columns[k + 1].front;
            const Vec2 by_unit = pushOf(behind, factor);
            force += push * by_unit;
            moment += push * turning(column, behind.top - column.pivot, by_unit);
        } else {
            state.moving = 0;
            state.topples = false;
        }
        const double slides = sliding(column, force, factor);
        ++state.moving;
        if (!column.front) {
            const double weight = column.force.norm(), topples = moment / column.arm;
            state.excess = std::max(topples, slides) / weight;
            state.topples = state.topples || topples > slides;
            break;
        }
        const Vec2 by_unit = pushOf(*column.front, factor);
        const auto by_moment = least(moment, turning(column, column.front->top - column.pivot, by_unit));
        const auto by_slide = least(slides, sliding(column, by_unit, factor));
        if (!by_moment || !by_slide) return std::nullopt;
        push = std::max(*by_moment, *by_slide);
        state.topples = state.topples || *by_moment > *by_slide;
    }
    return state;
}

}  // namespace talus::keyblocks
