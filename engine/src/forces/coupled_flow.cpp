#include "forces/coupled_flow.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "flow/cubic_law.h"
#include "flow/flow_in.h"
#include "flow/meshing.h"
#include "flow/opening.h"
#include "forces/flow_water.h"

namespace talus::flow_water {
namespace {

// Of the share that is put in, where changes do not become smaller. It sets the number of passes, not the
// pressure at which they end.
constexpr double kLess = 0.5;

/// Of a triangle that carries water.
/// \param opened  at its places, since its aperture was as stated [m]
void add(double stated, std::span<const double, flow::kPlaces> opened, double residual_share,
         ApertureDoubts& doubts) {
    ++doubts.wet;
    const auto corners = opened.last<flow::kPlaces - 1>();
    const double widest = *std::max_element(corners.begin(), corners.end());
    if (flow::isCapped(stated, widest)) ++doubts.capped;
    doubts.most = std::max(doubts.most, 1 + widest / stated);
    double least = kInfinity, most = 0;
    for (const double u : corners) {
        const double b = flow::hydraulicAperture(stated, u, residual_share);
        least = std::min(least, b), most = std::max(most, b);
    }
    doubts.taper = std::max(doubts.taper, most / least);
}

}  // namespace

double pressureChange(const std::vector<double>& before, const std::vector<double>& after) {
    double most = 0, change = 0;
    for (std::size_t n = 0; n < before.size(); ++n) {
        const double a = std::max(0.0, before[n]), b = std::max(0.0, after[n]);
        most = std::max({most, a, b});
        change = std::max(change, std::abs(b - a));
    }
    return most > 0 ? change / most : 0;
}

CoupledFlow::CoupledFlow(const State& built)
    : flow_(*built.geometry->model.flow),
      network_(flow::networkOf(built, flow_.refinements, flow_.boundaries)),
      stated_(flow::statedApertures(network_, flow_)) {}

void CoupledFlow::takeAsStated(State& state) const {
    state.coupled_pressure.stated_opening = flow::openings(state, network_);
}

double CoupledFlow::tiltOf(const State& state) const {
    return tilt_from_ ? std::max(*tilt_from_, state.load.tilt) : state.geometry->model.gravity.tilt;
}

std::vector<double> CoupledFlow::opened(const State& state) const {
    const std::vector<double>& before = state.coupled_pressure.stated_opening;
    std::vector<double> opened = flow::openings(state, network_);
    for (std::size_t k = 0; k < opened.size(); ++k) opened[k] -= before[k];
    return opened;
}

std::vector<flow::Corners> CoupledFlow::apertures(const State& state) const {
    const std::vector<double> change = opened(state);
    std::vector<flow::Corners> apertures = stated_;
    for (std::size_t t = 0; t < apertures.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
            apertures[t][k] = flow::hydraulicAperture(stated_[t][k], change[flow::kPlaces * t + 1 + k],
                                                      flow_.residual_share);
    return apertures;
}

/// Full joints conduct whatever their pressure; others where any corner is below the free surface.
bool CoupledFlow::carriesWater(const State& state, std::size_t triangle) const {
    return std::ranges::any_of(network_.triangles[triangle], [&](std::int32_t node) {
        const double head = state.coupled_pressure.pressure_head[static_cast<std::size_t>(node)];
        return head > 0 || (!flow_.free_surface && head != 0);
    });
}

ApertureDoubts CoupledFlow::doubtsOf(const State& state) const {
    ApertureDoubts doubts;
    const std::size_t places = state.coupled_pressure.stated_opening.size();
    if (places != flow::kPlaces * stated_.size() || !(state.load.water_share > 0)) return doubts;
    const std::vector<double> change = opened(state);
    for (std::size_t t = 0; t < stated_.size(); ++t)
        if (carriesWater(state, t))
            add(stated_[t][0], std::span(change).subspan(flow::kPlaces * t).first<flow::kPlaces>(),
                flow_.residual_share, doubts);
    return doubts;
}

Result<SteadyFlow> CoupledFlow::flowIn(const State& state) const {
    return flow::flowThrough({network_, apertures(state), tiltOf(state)}, state, flow_);
}

bool CoupledFlow::renew(State& state, int pass) {
    CoupledPressure& acting = state.coupled_pressure;
    if (!(state.load.water_share > 0) || acting.stated_opening.empty()) return false;
    ++flows_;
    Result<SteadyFlow> found = flowIn(state);
    if (!found) {
        if (!not_found_) not_found_ = found.errors().front();
        return false;
    }
    acting.change = pressureChange(acting.pressure_head, found->pressure_head);
    if (acting.change <= flow_.coupling_tolerance) return false;
    if (pass >= flow_.coupling_passes) {
        not_converged_ = std::max(not_converged_, acting.change);
        return false;
    }
    if (pass == 0)
        weight_ = 1;
    else if (acting.change >= last_change_)
        weight_ *= kLess;
    last_change_ = acting.change;
    passes_ = std::max(passes_, pass + 1);
    putIn(state, std::move(*found));
    return true;
}

void CoupledFlow::putIn(State& state, SteadyFlow flow) const {
    std::vector<double>& acting = state.coupled_pressure.pressure_head;
    const double unit_weight = flow_.density * state.geometry->model.gravity.magnitude;
    for (std::size_t n = 0; n < acting.size(); ++n) {
        acting[n] += weight_ * (flow.pressure_head[n] - acting[n]);
        flow.pressure[n] = unit_weight * std::max(0.0, acting[n]);
    }
    flow.pressure_head = acting;
    state.coupled_pressure.push = ownPushes(state, flow);
}

FlowCoupling CoupledFlow::coupling(const State& state) const {
    return {.refinements = flow_.refinements,
            .passes = passes_,
            .flows = flows_,
            .last_change = state.coupled_pressure.change,
            .largest_change = not_converged_,
            .converged = flows_ > 0 && not_converged_ == 0 && !not_found_};
}

}  // namespace talus::flow_water
