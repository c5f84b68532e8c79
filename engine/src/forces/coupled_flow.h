#pragma once
// Flow whose hydraulic apertures follow the joints, from equilibrium to equilibrium.
//
//   as stated:  the first equilibrium, under weight alone; there each joint has its stated aperture
//   pass:       openings since then -> apertures -> flow -> pressure -> equilibrium again
//   until:      the flow of the equilibrium has the pressure that acts there, to the tolerance
//
// A pass puts the new pressure in place of the old one. Where the change does not become smaller from pass to
// pass, half of it is put in, then a quarter, and so on.
//
// Reads:  shapes and interfaces as built; poses, load
// Writes: state.coupled_pressure

#include <optional>
#include <vector>

#include "flow/network.h"
#include "flow/upstream.h"
#include "state/arrays.h"
#include "talus/flow.h"

namespace talus::flow_water {

/// Largest difference of two pressures of the same nodes, over the larger of their maxima; negative ones
/// count as zero. 0 where there is no pressure.
double pressureChange(const std::vector<double>& before, const std::vector<double>& after);

/// How far a linear pressure on each triangle, and no aperture above a cap, are true of the joints of a state.
struct ApertureDoubts {
    double taper = 1;        ///< of a wet triangle, at most: largest aperture at a corner over the smallest
    std::size_t wet = 0;     ///< triangles that carry water
    std::size_t capped = 0;  ///< of these, those whose aperture is the largest that counts
    double most = 0;         ///< largest aperture over the stated one, had all counted
};

class CoupledFlow {
 public:
    /// \pre  the state as built, of a model whose flow is coupled
    explicit CoupledFlow(const State& built);

    /// From this tilt on, gravity of the flow is tilted as in the state [rad]. Else it is as in the model.
    void followTilt(double from) { tilt_from_ = from; }

    /// Apertures are as stated while joints are as open as in this state.
    void takeAsStated(State& state) const;

    /// In equilibrium: computes the flow, and puts its pressure in if it differs from that in the state.
    /// \param pass  counted from 0 at each equilibrium
    /// \return whether pressure has changed: then equilibrium is to be found again
    bool renew(State& state, int pass);

    /// In the joints as open as they are. Errors: as of flow::flowThrough.
    Result<SteadyFlow> flowIn(const State& state) const;

    std::size_t triangles() const { return stated_.size(); }
    FlowCoupling coupling(const State& state) const;
    /// None before apertures are taken as stated.
    ApertureDoubts doubtsOf(const State& state) const;
    /// Why the flow of an equilibrium was not found; the pressure before was kept there.
    const std::optional<Error>& notFound() const { return not_found_; }

 private:
    std::vector<double> opened(const State& state) const;  ///< at the places of flow::openings [m]
    std::vector<flow::Corners> apertures(const State& state) const;
    bool carriesWater(const State& state, std::size_t triangle) const;
    double tiltOf(const State& state) const;
    void putIn(State& state, SteadyFlow flow) const;

    const Flow flow_;
    const flow::Network network_;
    std::vector<flow::Corners> stated_;  ///< apertures, one a triangle at all its corners [m]
    std::optional<double> tilt_from_{};
    double weight_ = 1;       ///< share of a change that is put in
    double last_change_ = 0;  ///< of the pass before
    int passes_ = 0, flows_ = 0;
    double not_converged_ = 0;          ///< largest change left after the last pass
    std::optional<Error> not_found_{};  ///< of the first flow that was not
};

}  // namespace talus::flow_water
