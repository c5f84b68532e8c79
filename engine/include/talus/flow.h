#pragma once
// Steady flow of water in the joint network: laminar flow between parallel walls (the cubic law) in every
// joint that bounds a free block, as the blocks lie at the start. Rock is impermeable.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "talus/control.h"
#include "talus/model.h"
#include "talus/result.h"

namespace talus {

/// What passes through one boundary.
struct BoundaryFlow {
    std::string name;
    std::size_t nodes = 0;
    /// Into and out of the network [m^3/s]. Places with a head count net, and those of an outlet.
    double inflow = 0, outflow = 0;
    double highest_outflow = -kInfinity;  ///< elevation up to which water flows out [m]; none: -infinity
};

/// Water in the joints. Triangles are those of the mesh that the heads are linear on.
struct SteadyFlow {
    std::vector<Vec3> nodes;       ///< model frame [m]
    std::vector<double> head;      ///< along -g above the model's origin [m]; nan where no head reaches
    std::vector<double> pressure;  ///< rho g (head - elevation), not below zero with a free surface [Pa]
    /// head - elevation, below zero above the free surface; 0 where no head reaches [m]
    std::vector<double> pressure_head;
    std::vector<double> inflow;  ///< into the network at each node; zero but at boundaries [m^3/s]

    std::vector<std::array<std::int32_t, 3>> triangles;
    std::vector<std::int32_t> joint, block_a, block_b;  ///< of each triangle
    std::vector<Vec3> normal;                           ///< of each triangle, from a to b
    std::vector<double> aperture;                       ///< hydraulic, of each triangle [m]
    std::vector<Vec3> discharge;                        ///< per width of the joint [m^2/s]
    std::vector<double> wet_share;  ///< mean relative conductivity of a triangle's corners, 1: full

    std::vector<BoundaryFlow> boundaries;  ///< in the model's order
    std::vector<Vec3> free_surface;        ///< where edges of the mesh pass from wet to dry, model frame [m]
    double lowest_surface = 0, highest_surface = 0;  ///< elevations of these [m]
    std::size_t patches = 0;                         ///< polygons where two blocks touch
    std::size_t unreached_patches = 0;               ///< without a connection to a head: dry
    double inflow_sum = 0, outflow_sum = 0;          ///< [m^3/s]
    /// largest sum of flows at a node that is no boundary [m^3/s]
    double imbalance = 0;
    int iterations = 0;   ///< of the free surface; of outlets alone without one
    double residual = 0;  ///< largest imbalance of a node after the last one, over the inflow
    /// suction at which a joint above the free surface conducts a half: how sharp the surface is [m]
    double ramp = 0;
    std::optional<FlowCoupling> coupling{};  ///< of coupledFlow
    /// Of coupledFlow: removed before, as by a search (SearchResult::fallen_at_start); sorted
    std::vector<std::string> fallen_at_start{};
    std::vector<std::string> warnings;

    bool isWet(std::size_t triangle) const;  ///< whether pressure acts at any of its corners
};

/// How far the mesh decides discharges: against one of half or twice the size. Its triangles are the other
/// flow's divided into four, or the other way round.
struct MeshChange {
    int refinements = 0;             ///< of the other mesh: one less, or 1 where there is none
    std::size_t triangles = 0;       ///< of the other mesh
    std::vector<double> boundaries;  ///< (other - this) / this, of what passes each; nan where nothing does
    double total = 0;                ///< likewise of the inflow; nan where nothing flows
};

/// \pre model.flow. Errors: those of the model; a boundary at which no joint lies; a network without a head;
/// a free surface that was not found.
/// Progress is told at each iteration, with the size of the mesh.
Result<SteadyFlow> steadyFlow(const Model& model, const Control& control = {});

/// The same with apertures that follow the joints, at the equilibrium under the model's own loads. Blocks
/// that fall under their weight whatever the strength are removed and named, as by a search. Without
/// equilibrium, an error.
/// \pre model.flow->coupled
Result<SteadyFlow> coupledFlow(const Model& model, const Control& control = {});

/// Computes the flow once more. \param flow  that of the model. Errors: of the flow on the other mesh; one
/// too large to be worth its time
Result<MeshChange> meshChange(Model model, const SteadyFlow& flow, const Control& control = {});

}  // namespace talus
