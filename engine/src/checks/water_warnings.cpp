#include "checks/water_warnings.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "checks/water_levels.h"
#include "flow/cubic_law.h"
#include "flow/flow_in.h"
#include "forces/phreatic.h"
#include "forces/sum.h"
#include "forces/water.h"
#include "measure/words.h"
#include "model/gravity.h"
#include "state/block_motion.h"
#include "talus/angles.h"
#include "talus/wet_joint_name.h"

namespace talus::checks {
namespace {

// Largest aperture at a corner over the smallest. Heads at the corners are exact where water flows along the
// taper, but the pressure between them is linear, and the true one is higher. Factors of safety of two blocks
// on a wedge (guide to flow) were 1.2 and 1.7 % too large at 1.3, 0.3 and 0.4 % below 1.2.
constexpr double kTaper = 1.2;

// Triangles of a mesh that is refined without being asked to, and refinements. A search computes a hundred flows and
// more, and one through as many triangles takes some 0.1 s with a free surface.
constexpr std::size_t kMostRefinedTriangles = 10'000;
constexpr int kMostRefinements = 5;
constexpr int kRefinementsAtOnce = 2;  // the slope fails earlier on the finer mesh, and opens its joints less
constexpr double kPushed = 0.05;       // of a block's weight: less water does not move it

/// Of all water on a block, over its weight. \pre forces are up to date
double waterShare(const State& state, std::size_t block) {
    const double weight = state.blocks.mass[block] * state.geometry->model.gravity.magnitude;
    return weight > 0 ? turningForcesOn(state, block).force.norm() / weight : 0.0;
}

/// The first that never drains of those that wet a block.
std::optional<std::string> undrainedOn(const State& state, std::size_t block) {
    const Model& model = state.geometry->model;
    const double never = state.geometry->length_scale;  // a joint that opens so wide is no longer one
    for (std::size_t w = 0; w < state.wet.size(); ++w) {
        const Water& water = model.waters[static_cast<std::size_t>(state.wet.water[w])];
        if (water.closed) continue;  // falls as its joint opens
        if (state.wet.block[w] == static_cast<std::int32_t>(block) && water.drains_at_aperture >= never)
            return water.field;
    }
    if (model.phreatic && model.phreatic->drains_at_aperture >= never) return model.phreatic->field;
    return std::nullopt;
}

constexpr const char* kWetsNothing = "it wets no free block";

/// The scenario's key for where it stands.
const char* levelKey(const Water& water) {
    if (water.kind == Water::Level::head) return ".head";
    const bool over_time = water.level.size() > 1;
    if (water.kind == Water::Level::elevation) return over_time ? ".elevations" : ".elevation";
    return over_time ? ".levels" : ".depth";
}

/// A joint derived from one of the file's ("default@18.5deg") is named as that one.
std::string nameInFile(const Joint& joint) { return joint.name.substr(0, joint.name.find('@')); }

std::string atTilt(const Model& model) {
    const double tilt_deg = degrees(model.gravity.tilt);
    return tilt_deg == 0 ? ""
                         : " (heights along gravity at a tilt of " + formatted("%.4g", tilt_deg) + " deg)";
}

/// Heights within a nanometre of 0 are 0 but for rounding.
std::string metres(double height) {
    constexpr double kNothing = 1e-9;  // [m]
    return formatted("%.4g", std::abs(height) < kNothing ? 0.0 : height) + " m";
}

Error doubtOf(const Model& model, const Water& water, const DryWater& dry) {
    const std::string wets_nothing = atTilt(model) + std::string(": ") + kWetsNothing;
    const std::string stands = "found water up to " + metres(dry.table) + ", which is not above ";
    switch (dry.why) {
        case DryWater::Why::no_free_wall:
            break;
        case DryWater::Why::falls_from_nothing:
            return {water.field + ".daylights", stands + "the joint's upper end, at " + metres(dry.wall) +
                                                    ", from where the pressure falls" + wets_nothing};
        case DryWater::Why::table_too_low:
            return {water.field + levelKey(water),
                    stands + "the lowest of its walls on free blocks, at " + metres(dry.wall) + wets_nothing};
        case DryWater::Why::no_head:
            return {water.field + levelKey(water),
                    std::string("found heads that leave its walls on free blocks dry: ") + kWetsNothing};
    }
    const bool has_base = water.base > -kInfinity;
    return {water.field + (has_base ? ".base" : levelKey(water)),
            std::string("found no wall of a free block") +
                (has_base ? " above its base, " + formatted("%.4g", water.base) + " m: " : ": ") +
                kWetsNothing};
}

/// Whether no face of a free block lies below a water table.
bool isDry(const State& state, const PhreaticSurface& surface) {
    const Model& model = state.geometry->model;
    const double unit_weight = surface.density * model.gravity.magnitude;
    const phreatic::Cells cells = phreatic::cellsOf(surface, downward(model.gravity, state.load.tilt),
                                                    unit_weight, state.geometry->origin);
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (state.blocks.motion[b] != Motion::free) continue;
        const Polyhedron& shape = state.geometry->shape[b];
        const Vec3 position = state.blocks.position.get(b);
        const Mat3 turn = state.blocks.orientation.matrix(b);
        const double least = kPresses * state.blocks.mass[b] * model.gravity.magnitude;
        for (std::size_t face = 0; face < shape.faces.size(); ++face) {
            const Wrench pressure =
                phreatic::pressureOn(cells, phreatic::outlineIn(shape, face), position, turn);
            if (pressure.force.norm() > least) return false;
        }
    }
    return true;
}

/// Where an answer differs from that with the joint's ends at all its walls. A share of a joint's height
/// never meant anything else.
std::optional<Error> otherEnds(const State& state, std::size_t index) {
    constexpr double kSameEnds = 1e-6;  // of the joint's height
    const Water& water = state.geometry->model.waters[index];
    const bool falls = water.daylight != Water::Daylight::closed || water.kind == Water::Level::head;
    if (isNothing(water) || water.is_share || (!falls && water.kind != Water::Level::depth))
        return std::nullopt;
    const auto ends = movedEnds(state, index);
    if (!ends) return std::nullopt;
    const double same = kSameEnds * (ends->high_with_fixed - ends->low_with_fixed);
    const auto differ = [&](double now, double before) { return std::abs(now - before) > same; };
    const auto text = [](double height) { return formatted("%.4g", height) + " m"; };
    const std::string meant = "; earlier versions used the end of the whole joint, fixed rock included, at ";
    const std::string key =
        water.field + (water.daylight != Water::Daylight::closed ? ".daylights" : levelKey(water));
    if (differ(ends->low, ends->low_with_fixed))
        return Error{key, "the joint's lower end is its lowest point on a free block, at " + text(ends->low) +
                              meant + text(ends->low_with_fixed)};
    if (falls && differ(ends->high, ends->high_with_fixed))
        return Error{key, "the joint's upper end is its highest point on a free block, at " +
                              text(ends->high) + meant + text(ends->high_with_fixed)};
    return std::nullopt;
}

}  // namespace

std::vector<Error> wetStrengthOfDryJoints(const Model& model) {
    std::vector<Error> doubts;
    const bool has_level =
        model.phreatic || model.flow || !std::all_of(model.waters.begin(), model.waters.end(), isNothing);
    if (model.is_remainder || !has_level) return doubts;
    std::set<std::string> dry, wet;
    for (const Joint& joint : model.joints) {
        if (readWetJointName(joint.name))
            wet.insert(nameInFile(joint));
        else if (joint.wet_strength_factor != 1)
            dry.insert(nameInFile(joint));
    }
    for (const std::string& name : dry)
        if (wet.count(name) == 0)
            doubts.push_back({"joint." + name + ".wet_strength_factor",
                              "it has no effect, because no water wets an area of this joint"});
    return doubts;
}

std::vector<Error> dryWaters(const State& state) {
    const Model& model = state.geometry->model;
    std::vector<Error> doubts;
    if (model.is_remainder || !(model.gravity.magnitude > 0)) return doubts;
    for (std::size_t w = 0; w < model.waters.size(); ++w) {
        // A share that does not reach up to the crack's base leaves the crack dry, as it says.
        if (isNothing(model.waters[w]) || model.waters[w].is_share) continue;
        if (const auto dry = whyDry(state, w)) doubts.push_back(doubtOf(model, model.waters[w], *dry));
    }
    for (std::size_t w = 0; w < model.waters.size(); ++w)
        if (auto other = otherEnds(state, w)) doubts.push_back(std::move(*other));
    if (model.phreatic && isDry(state, *model.phreatic)) {
        doubts.push_back({model.phreatic->field + (model.phreatic->line.empty() ? ".obj" : ".surface"),
                          std::string("found a water table below all free blocks: ") + kWetsNothing});
    }
    if (model.flow)
        for (Error& doubt : flow::doubtsOf(state, *model.flow)) doubts.push_back(std::move(doubt));
    return doubts;
}

namespace {

/// What to look at where water pushes blocks off.
std::string whyItPushes(const State& state) {
    if (const auto high = levelsAboveJoints(state); !high.empty())
        return high.front().field + " stands above the upper end of its joint";
    if (state.geometry->model.flow)
        return "Heads of " + state.geometry->model.flow->field +
               " above the height of a joint's mouth press on its walls up to there: compare the heads with "
               "the heights of the surface";
    return "A level water table acts with its full pressure up to where joints daylight. In a slope that "
           "drains, the table falls towards the face ([[water]] surface), or its pressure has a factor below "
           "1";
}

}  // namespace

std::optional<std::string> pushedByWater(const State& built, const std::vector<std::size_t>& falling) {
    if (!built.geometry->model.hasWater() || falling.empty()) return std::nullopt;
    State wet = built;
    wet.load.water_share = 1;
    updateBlockForces(wet);
    std::size_t count = 0, worst = 0;
    double most = 0;
    for (const std::size_t block : falling) {
        const double share = waterShare(wet, block);
        if (share < kPushed) continue;
        ++count;
        if (share > most) most = share, worst = block;
    }
    if (count == 0) return std::nullopt;
    return "water pushes " + std::to_string(count) + " of the blocks that fall whatever the strength, \"" +
           wet.geometry->model.blocks[worst].name + "\" with " + formatted("%.3g", most) +
           " times its weight. " + whyItPushes(wet);
}

std::optional<std::string> pushedAway(const State& state) {
    if (!state.geometry->model.hasWater()) return std::nullopt;
    std::optional<State>
        before;  // as they lay at the start: they may have moved far from the water that pushed them
    for (std::size_t block = 0; block < state.blocks.size(); ++block) {
        if (state.blocks.motion[block] != Motion::free) continue;
        const Vec3 way = state.blocks.position.get(block) - state.geometry->initial_position.get(block);
        if (way.norm() < 0.5 * state.geometry->size[block]) continue;
        const auto water = undrainedOn(state, block);
        if (!water) continue;
        if (!before) {
            before = state;
            before->blocks.position = state.geometry->initial_position;
            before->blocks.orientation = state.geometry->initial_orientation;
            updateBlockForces(*before);
        }
        if (waterShare(*before, block) < kPushed) continue;
        return *water + " never drains: block \"" + state.geometry->model.blocks[block].name +
               "\" is displaced by " + formatted("%.2g", way.norm()) +
               " m, still under the pressure of its closed joints; with drains_at_aperture (for example "
               "0.001 m) joints drain as they open";
    }
    return std::nullopt;
}

namespace {

std::string ofPasses(const Flow& flow, double change) {
    return flow.field + ".coupling_passes: after " + std::to_string(flow.coupling_passes) +
           " passes at an equilibrium the pressure of the flow still changes by " +
           formatted("%.2g", change) + " of its largest value, and coupling_tolerance allows " +
           formatted("%.2g", flow.coupling_tolerance) +
           ": flow and opening of the joints do not agree there; allowed: more passes";
}

std::string ofTaper(const Flow& flow, const flow_water::ApertureDoubts& doubts) {
    return flow.field + ".refinements: found " + std::to_string(flow.refinements) +
           ", at which apertures at the corners of a triangle differ by a factor of " +
           formatted("%.3g", doubts.taper) +
           " in the last equilibrium; the pressure is linear on each triangle, and the error of the "
           "answer may be on the unsafe side; allowed without this warning: so many refinements that the "
           "factor is "
           "at most " +
           formatted("%.2g", kTaper);
}

std::string ofCap(const Flow& flow, const flow_water::ApertureDoubts& doubts) {
    return flow.field + ".aperture: " + std::to_string(doubts.capped) + " of the " +
           std::to_string(doubts.wet) + " triangles that carry water have opened to more than " +
           formatted("%g", flow::kMostOpened) +
           " times their stated aperture in the last equilibrium, up to " + formatted("%.3g", doubts.most) +
           " times, and count as " + formatted("%g", flow::kMostOpened) +
           " times; where no tighter joint lies in series the pressure may be too low, and the answer on the "
           "unsafe side; compare with the answer for larger stated apertures";
}

}  // namespace

std::vector<std::string> ofCoupling(const flow_water::CoupledFlow& coupled, const State& last) {
    const Flow& flow = *last.geometry->model.flow;
    std::vector<std::string> warnings;
    if (const double change = coupled.coupling(last).largest_change; change > 0)
        warnings.push_back(ofPasses(flow, change));
    if (const auto& why = coupled.notFound())
        warnings.push_back(why->field +
                           ": at an equilibrium the flow in the joints as open as they are was "
                           "not found, and the pressure before was kept: " +
                           why->message);
    const flow_water::ApertureDoubts doubts = coupled.doubtsOf(last);
    if (doubts.taper > kTaper) warnings.push_back(ofTaper(flow, doubts));
    if (doubts.capped > 0) warnings.push_back(ofCap(flow, doubts));
    return warnings;
}

int moreRefinements(const flow_water::CoupledFlow& coupled, const State& last) {
    const int refinements = last.geometry->model.flow->refinements;
    std::size_t triangles = coupled.triangles();
    int more = 0;
    // Each refinement halves the difference of two apertures at the corners of a triangle.
    for (double left = coupled.doubtsOf(last).taper - 1; left > kTaper - 1; left /= 2) {
        triangles *= 4;
        if (triangles > kMostRefinedTriangles || refinements + more == kMostRefinements) break;
        if (++more == kRefinementsAtOnce) break;
    }
    return more;
}

std::optional<std::string> flowOfOtherTilt(const Model& model) {
    if (!model.flow || model.flow->coupled) return std::nullopt;
    return model.flow->field + ": the pressure is that of the flow at the scenario's tilt, " +
           formatted("%.4g", degrees(model.gravity.tilt)) +
           " deg, at every tilt, and turns with the blocks. Set gravity.tilt_deg to the answer and search "
           "for "
           "the safety factor, or set coupled = true without a wet_strength_factor: the flow then follows "
           "the "
           "tilt";
}

std::optional<std::string> flowAsStated(const Model& model, const std::string& why) {
    if (!model.flow || !model.flow->coupled) return std::nullopt;
    return model.flow->field + ".coupled: " + why +
           "; the pressure is that of the flow with the stated apertures";
}

}  // namespace talus::checks
