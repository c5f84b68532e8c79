#include "search/unloaded_joints.h"

#include <algorithm>
#include <cmath>

#include "forces/contact_forces.h"
#include "state/incidence.h"

namespace talus::search {
namespace {

constexpr double kFrictionless = 1e-3;  // tan(phi): none, but for a matrix that stays regular

double lighterWeight(const State& state, std::size_t i) {
    const double g = state.geometry->model.gravity.magnitude;
    double weight = kInfinity;
    for (const std::int32_t block : {state.interfaces.block_a[i], state.interfaces.block_b[i]}) {
        const auto b = static_cast<std::size_t>(block);
        if (state.blocks.motion[b] == Motion::free) weight = std::min(weight, g * state.blocks.mass[b]);
    }
    return weight;
}

void addFrictionless(const Model& model, State& state) {
    const std::size_t own = model.joints.size();
    state.laws.resize(own);
    for (std::size_t j = 0; j < own; ++j) {
        contact::JointLaw law = state.laws[j];
        law.setCurve(nullptr);
        law.tan_friction = law.residual_tan_friction = kFrictionless;
        law.cohesion = law.residual_cohesion = law.tan_dilation = 0;
        state.laws.push_back(std::move(law));
    }
}

}  // namespace

UnloadedJoints::UnloadedJoints(const State& state, double carries_nothing) {
    const Interfaces& f = state.interfaces;
    std::set<std::pair<std::int32_t, std::int32_t>> loaded;
    for (std::size_t i = 0; i < f.size(); ++i) {
        if (isIdle(f, i)) continue;
        const auto joint = static_cast<std::size_t>(f.joint[i]);
        const std::pair pair = std::minmax(f.block_a[i], f.block_b[i]);
        double normal = 0;
        for (const ContactPoint& point : contactPoints(state, i)) normal += std::abs(point.force.normal);
        const bool carries =
            normal > carries_nothing * lighterWeight(state, i) || contact::holdsUnloaded(state.laws[joint]);
        (carries ? loaded : pairs_).insert(pair);
    }
    for (const auto& pair : loaded) pairs_.erase(pair);
}

double UnloadedJoints::shearCarried(const State& state) const {
    const Interfaces& f = state.interfaces;
    double shear = 0;
    for (std::size_t i = 0; i < f.size(); ++i) {
        if (isIdle(f, i) || pairs_.count(std::minmax(f.block_a[i], f.block_b[i])) == 0) continue;
        double sum = 0;
        for (const ContactPoint& point : contactPoints(state, i))
            sum += std::hypot(point.force.shear_1, point.force.shear_2);
        shear = std::max(shear, sum / lighterWeight(state, i));
    }
    return shear;
}

void UnloadedJoints::release(State& state) const {
    const Model& model = state.geometry->model;
    const auto own = static_cast<std::int32_t>(model.joints.size());
    if (state.laws.size() == model.joints.size()) addFrictionless(model, state);
    Interfaces& f = state.interfaces;
    for (std::size_t i = 0; i < f.size(); ++i)
        if (f.joint[i] < own && pairs_.count(std::minmax(f.block_a[i], f.block_b[i])) > 0) f.joint[i] += own;
}

LoadAxis UnloadedJoints::with(const LoadAxis& strength) const {
    LoadAxis axis = strength;
    axis.loading.apply = [apply = strength.loading.apply](State& state, double factor) {
        apply(state, factor);
        addFrictionless(state.geometry->model, state);
    };
    return axis;
}

}  // namespace talus::search
