#include "theory/section.h"

#include <algorithm>

namespace talus::theory {

namespace {

void add(Mass& sum, const Body& body) {
    sum.weight += body.weight;
    sum.weight_moment += body.weight_moment;
    sum.weight_lever += 0.5 * body.weight * body.length;
    sum.friction_force += body.tan_friction * (body.weight - body.uplift);
    sum.cohesion_force += body.cohesion_force;
    sum.thrust += body.back_thrust - body.front_thrust;
    sum.thrust_moment += body.back_moment - body.front_moment;
    sum.uplift_moment += body.uplift_front;
}

Body mirrored(Body body) {
    std::swap(body.back_thrust, body.front_thrust);
    std::swap(body.back_moment, body.front_moment);
    body.uplift_front = body.uplift * body.length - body.uplift_front;
    return body;
}

}  // namespace

Mass massOf(const Bed& bed, std::size_t first, std::size_t last) {
    Mass sum;
    for (std::size_t column = first; column <= last; ++column) add(sum, *bed.columns[column]);
    return sum;
}

Section mirrored(const Section& section) {
    Section result = section;
    for (Bed& bed : result.beds) {
        std::reverse(bed.columns.begin(), bed.columns.end());
        for (auto& body : bed.columns)
            if (body) body = mirrored(*body);
    }
    return result;
}

}  // namespace talus::theory
