#pragma once
// Steady flow in the joint network, as a scenario describes it. What is computed from it: talus/flow.h.

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "talus/polyhedron.h"

namespace talus {

/// What holds at some places of the network: a head, or water that can only flow out.
struct FlowBoundary {
    enum class Kind : std::uint8_t {
        head,    ///< the head is given; with a free surface, places above it are an outlet
        outlet,  ///< seepage face or drain: pressure zero where water flows out, no flow elsewhere
    };
    Kind kind = Kind::head;
    double head = 0;  ///< along -g above the model's origin [m]
    /// Open ends of joints on rock faces that look this way within 60 degrees. Nothing: all of the joints.
    std::optional<Vec3> face{};
    std::vector<std::int32_t> joints{};  ///< in these joints only; empty: in any
    Vec3 box_min = Vec3::Constant(-std::numeric_limits<double>::infinity());  ///< inside this box only [m]
    Vec3 box_max = Vec3::Constant(std::numeric_limits<double>::infinity());
    std::string name{};
    std::string field{};  ///< "flow.boundary[0]", for messages
};

/// Laminar flow between parallel walls (the cubic law) in every joint that bounds a free block.
struct Flow {
    double aperture = 0;  ///< hydraulic, of all joints but those named below [m]
    std::vector<std::pair<std::int32_t, double>> joint_apertures{};  ///< joint and its aperture [m]
    double viscosity = 1.307e-3;  ///< dynamic; water at 10 degrees C [Pa s]
    double density = 1000;        ///< [kg/m^3]
    bool free_surface = true;     ///< false: all joints are full
    int refinements = 0;          ///< how many times each triangle of the mesh is divided into four
    /// Coupled: searches and coupledFlow refine further, as far as joints taper (FlowCoupling::refinements).
    bool refines = false;
    /// Apertures follow the opening and closure of joints, equilibrium by equilibrium (coupledFlow).
    bool coupled = false;
    double residual_share = 0.1;  ///< coupled: of its stated aperture, what a joint keeps at least
    /// Coupled: change of pressure between two passes over the largest pressure; below it they agree.
    double coupling_tolerance = 1e-3;
    int coupling_passes = 30;  ///< coupled: most passes at one equilibrium
    std::vector<FlowBoundary> boundaries{};
    std::string field{};  ///< "flow", for messages
};

/// How well the opening of joints and the pressure in them agree.
struct FlowCoupling {
    int refinements = 0;        ///< of the mesh that was used
    int passes = 0;             ///< largest number that changed the pressure at one equilibrium
    int flows = 0;              ///< computed on that mesh
    double last_change = 0;     ///< of pressure, at the equilibrium of the result, over the largest pressure
    double largest_change = 0;  ///< the same where it stayed above the tolerance, of any equilibrium
    bool converged = false;     ///< whether every equilibrium was within the tolerance
};

}  // namespace talus
