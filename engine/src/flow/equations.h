#pragma once
// The balance of flow at the nodes of a network, and its derivative by the heads.
//
// div(T k grad h) = 0 in the plane of each joint: T by the cubic law, k the share of the joint that carries
// water. It is 1 under pressure, FreeSurface::dry_share above the free surface, and a ramp between.
// With q_i the inflow at node i of a full triangle: R_i = sum of k q_i, and
// dR_i/dh_j = sum of k dq_i/dh_j + q_i dk/dh_j over the triangles of the node.

#include <utility>
#include <vector>

#include "flow/conditions.h"
#include "flow/sparse.h"
#include "flow/structure.h"

namespace talus::flow {

/// What the free surface is smeared with. tests/engine/flow/free_surface_test.cpp says how far answers move
/// with each.
struct FreeSurface {
    /// Share of its transmissivity that a joint above the free surface keeps, so that the equations stay
    /// regular. The discharge through the dry part is about this share of that through the wet part.
    double dry_share = 1e-5;
    /// Of a patch's height: the pressure head below zero over which a joint runs dry, in the last stage at
    /// least. A wider one raises the free surface by as much; a narrower one rarely converges in irregular networks.
    double last_ramp = 1.0 / 32;
};

/// Heads count from a datum, the lowest given head: little is lost to rounding far above sea level.
class Equations {
 public:
    /// \param transmissivity  of each triangle [m^2/s]
    Equations(const Network& network, const Conditions& conditions, const std::vector<double>& transmissivity,
              const FreeSurface& surface = {});

    std::size_t triangles() const { return stiffness_.size(); }
    double size() const { return network_->size; }      ///< of a patch [m]
    double height() const { return network_->height; }  ///< of a patch [m]
    double datum() const { return datum_; }             ///< [m]
    bool isHeld(std::size_t node) const { return held_[node] != 0; }
    /// Which nodes are held: outlets open and close, and a stage that fails takes that back.
    const std::vector<char>& held() const { return held_; }
    void setHeld(std::vector<char> held) { held_ = std::move(held); }

    /// Puts the given heads, and the elevations of outlets that are open, into these.
    void hold(Vector& heads) const;
    /// Closes outlets that would draw water in, opens closed ones under pressure. \return whether any was
    bool switchOutlets(const Vector& heads, const Vector& inflow);

    /// k of each triangle under these heads. \param ramp  see wetShare [m]
    std::vector<double> sharesOf(const Vector& heads, double ramp) const;
    /// Inflow into the network at each node with these shares [m^3/s].
    Vector inflows(const Vector& heads, const std::vector<double>& shares) const;
    /// Derivative of the inflows by the heads with constant shares; rows of held nodes are the identity's.
    SparseMatrix conductance(const std::vector<double>& shares) const;
    /// The same with shares that follow from the heads.
    SparseMatrix derivative(const Vector& heads, double ramp) const;

    /// Largest inflow at a node that is not held, over the sum of those that enter at held nodes. Infinite
    /// where an inflow is no number.
    double imbalance(const Vector& inflow) const;
    /// Whether that is as small as it gets: a share of the inflow, or all that rounding of the heads leaves.
    bool isBalanced(const Vector& heads, const std::vector<double>& shares, const Vector& inflow) const;
    /// Whether there are no differences of head to speak of.
    bool isStill(const Vector& heads) const;

 private:
    double heldHead(std::size_t node) const;
    bool isRounding(const Vector& heads, const std::vector<double>& shares, const Vector& inflow) const;
    std::array<double, 3> pressureHeads(const Vector& heads, std::size_t triangle) const;
    SparseMatrix identityOfHeld() const;
    void addConductance(const std::vector<double>& shares, SparseMatrix& matrix) const;
    void addShareSlopes(const Vector& heads, double ramp, SparseMatrix& matrix) const;
    void add(std::size_t triangle, std::size_t row, std::size_t column, double value,
             SparseMatrix& matrix) const;

    const Network* network_;
    const Conditions* conditions_;
    double dry_share_;
    std::vector<std::array<double, 3>> stiffness_;  ///< conductance between corners 0-1, 1-2, 2-0 [m^2/s]
    Structure structure_;
    std::vector<char> held_;  ///< 1: the head is no unknown
    double datum_ = 0;        ///< [m]
};

/// Gradients of the three shape functions of a triangle [1/m], and its area [m^2].
struct Gradients {
    std::array<Vec3, 3> of;
    double area = 0;
};
Gradients gradientsOf(const Network& network, std::size_t triangle);

}  // namespace talus::flow
