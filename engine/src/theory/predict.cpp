// The prediction for a whole model: its weakest mechanism, if the model can stand up to it.

#include <algorithm>
#include <charconv>
#include <cmath>

#include "build/wet_joints.h"
#include "measure/natural_order.h"
#include "talus/angles.h"
#include "talus/theory.h"
#include "theory/mechanisms.h"
#include "theory/section.h"

namespace talus::theory {

namespace {

constexpr double kJustBelow = 1e-6;      ///< the model must stand this much below its critical tilt [rad]
constexpr double kSteepest = 1.5533430;  ///< 89 deg: beyond it "tilt" means nothing [rad]

std::string number(double value) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 5).ptr;
    return std::string(text, end);
}

std::string kilonewtons(double force) { return number(force / 1000) + " kN"; }

/// "columns 1-2 above bed level 1"
std::string massName(const Section& section, const Mechanism& mechanism) {
    if (section.beds.size() == 1 && section.beds.front().columns.size() == 1) return "the block";
    const std::string first = std::to_string(mechanism.first_column + 1);
    const std::string last = std::to_string(mechanism.last_column + 1);
    const std::string columns =
        mechanism.first_column == mechanism.last_column ? "column " + first : "columns " + first + "-" + last;
    return columns + " above bed level " + std::to_string(section.beds[mechanism.bed].level);
}

std::string slidingFormula(const Mass& mass, const Body& toe) {
    const double uplift = toe.uplift;  // only a single block has any
    const bool lifted = uplift > 0;
    const std::string friction = "phi = " + number(degrees(std::atan(toe.tan_friction))) + " deg";
    const std::string thrust = ", V = " + kilonewtons(mass.thrust) + " (water thrust over cos(beta))";
    const std::string forces = friction + ", W = " + kilonewtons(mass.weight) +
                               (mass.thrust != 0 ? thrust : "") +
                               (lifted ? ", U = " + kilonewtons(uplift) + " (uplift over cos(beta))" : "");
    const std::string normal = lifted ? "(W - U)" : "W";
    if (mass.cohesion_force > 0)
        return "W sin(beta) + V cos(beta) = " + normal + " cos(beta) tan(phi) + C A, " + forces +
               ", C A = " + kilonewtons(mass.cohesion_force);
    if (lifted) return "tan(beta) = ((W - U) tan(phi) - V) / W, " + forces;
    if (mass.thrust != 0) return "tan(beta) = tan(phi) - V / W, " + forces;
    return "tan(beta) = tan(phi), " + friction;
}

std::string topplingFormula(const Mass& mass) {
    const double moment = mass.thrust_moment + mass.uplift_moment;
    const double lever = mass.weight_lever / mass.weight, height = mass.weight_moment / mass.weight;
    const std::string centroid =
        "a = " + number(lever) + " m, z = " + number(height) + " m (centroid from the edge)";
    if (moment == 0) return "tan(beta) = a / z, " + centroid;
    return "tan(beta) = (W a - M) / (W z), " + centroid + ", W = " + kilonewtons(mass.weight) +
           ", M = " + number(moment / 1000) + " kN m (water over cos(beta))";
}

std::string formula(const Section& section, const Mechanism& mechanism) {
    const Bed& bed = section.beds[mechanism.bed];
    const Mass mass = massOf(bed, mechanism.first_column, mechanism.last_column);
    return massName(section, mechanism) + (mechanism.topples ? " overturning: " : " sliding: ") +
           (mechanism.topples ? topplingFormula(mass)
                              : slidingFormula(mass, *bed.columns[mechanism.first_column]));
}

std::vector<std::string> blocksOf(const Model& model, const Section& section, const Mechanism& mechanism) {
    std::vector<std::string> names;
    for (std::size_t column = mechanism.first_column; column <= mechanism.last_column; ++column)
        for (const std::int32_t block : section.beds[mechanism.bed].columns[column]->blocks)
            names.push_back(model.blocks[static_cast<std::size_t>(block)].name);
    sortNaturally(names);
    return names;
}

std::string reasons(const Section& section) {
    const bool single = section.beds.size() == 1 && section.beds.front().columns.size() == 1;
    const std::string strength =
        "no residual strength below the peak, no tensile strength, and water at its depth at the start";
    return single ? "one free box on a level fixed face; " + strength
                  : "one stack with fissures that open freely, one strength per bed, and equal slices; " +
                        strength +
                        "; up to this tilt no column needs more support from its neighbour than frictionless "
                        "fissures can give";
}

}  // namespace

std::optional<Prediction> predict(const Model& model) {
    const bool weight_only = !model.gravity.direction && model.seismic.horizontal == 0 &&
                             model.seismic.vertical == 0 && !model.hasOtherForces() && !hasWetJoints(model);
    if (!(model.gravity.magnitude > 0) || !weight_only) return std::nullopt;
    const auto section = model.stack ? stackSection(model) : singleSection(model);
    if (!section) return std::nullopt;
    const Mechanism weakest = weakestMechanism(*section);
    if (!(weakest.tilt < kSteepest) || !canStand(*section, weakest.tilt - kJustBelow)) return std::nullopt;
    // Water may push uphill: a slope that moves uphill when the search starts has no critical tilt.
    const double start = model.analysis.start.value_or(model.gravity.tilt);
    if (!canStand(mirrored(*section), -start)) return std::nullopt;
    return Prediction{weakest.tilt, weakest.topples, formula(*section, weakest), reasons(*section),
                      blocksOf(model, *section, weakest)};
}

}  // namespace talus::theory
