#include "theory/mechanisms.h"

#include <algorithm>
#include <cmath>

namespace talus::theory {

namespace {

bool startsGroup(const Bed& bed, std::size_t column) {
    return bed.columns[column] && (column == 0 || !bed.columns[column - 1]);
}

void keepWeaker(Mechanism& best, const Mechanism& other) {
    // Ties differ by rounding only; the first one found stays.
    if (other.tilt < best.tilt - 1e-12) best = other;
}

/// All groups whose foremost column is `first`.
void weakestOfGroup(const Section& section, std::size_t bed_index, std::size_t first, Mechanism& best) {
    const Bed& bed = section.beds[bed_index];
    for (std::size_t last = first; last < bed.columns.size() && bed.columns[last]; ++last)
        keepWeaker(best, {bed_index, first, last, false, slidingTilt(massOf(bed, first, last))});
    keepWeaker(best, {bed_index, first, first, true, topplingTilt(massOf(bed, first, first))});
}

/// Push of a column on its downhill neighbour.
struct Push {
    double force = 0;   ///< [N]
    double moment = 0;  ///< about the bed's level [N m]
};

/// The least push with which column `column` stands; `contact_height`: of the fissure in front of it.
Push passOn(const Bed& bed, std::size_t column, const Push& from_behind, double contact_height, double tilt) {
    const Mass mass = massOf(bed, column, column);
    Push push;
    push.moment = std::max(0.0, from_behind.moment + topplingExcess(mass, tilt));
    push.force = std::max(0.0, from_behind.force + slidingExcess(mass, tilt));
    // The push acts on the fissure, so its lever is at most the fissure's height.
    if (contact_height > 0) push.force = std::max(push.force, push.moment / contact_height);
    return push;
}

/// True when the resultant on the base stays within the middle third without help from the neighbours: then
/// an elastic base is compressed everywhere.
bool baseIsClosed(const Bed& bed, std::size_t column, double tilt) {
    const Mass mass = massOf(bed, column, column);
    const Body& body = *bed.columns[column];
    const double normal = (body.weight - body.uplift) * std::cos(tilt);
    const double about_edge = -topplingExcess(mass, tilt);  // of the normal force about the downhill edge
    return std::abs(about_edge - 0.5 * normal * body.length) <= normal * body.length / 6;
}

bool bedCanStand(const Bed& bed, double tilt) {
    Push push;
    for (std::size_t column = bed.columns.size(); column-- > 0;) {
        if (!bed.columns[column]) {
            push = {};
            continue;
        }
        const Body& body = *bed.columns[column];
        if (body.cohesion_force > 0 && !baseIsClosed(bed, column, tilt)) return false;
        const bool foremost = startsGroup(bed, column);
        const double contact_height = foremost ? 0 : std::min(body.height, bed.columns[column - 1]->height);
        push = passOn(bed, column, push, contact_height, tilt);
        const double rounding = 1e-12 * body.weight;
        if (foremost && (push.force > rounding || push.moment > rounding * body.height)) return false;
    }
    return true;
}

}  // namespace

Mechanism weakestMechanism(const Section& section) {
    Mechanism best;
    best.tilt = kInfinity;
    for (std::size_t bed = 0; bed < section.beds.size(); ++bed)
        for (std::size_t column = 0; column < section.beds[bed].columns.size(); ++column)
            if (startsGroup(section.beds[bed], column)) weakestOfGroup(section, bed, column, best);
    return best;
}

bool canStand(const Section& section, double tilt) {
    return std::all_of(section.beds.begin(), section.beds.end(),
                       [tilt](const Bed& bed) { return bedCanStand(bed, tilt); });
}

}  // namespace talus::theory
