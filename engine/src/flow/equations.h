#pragma once
// The balance of flow at the nodes of a network, and its derivative by the heads.
//
// div(T k grad h) = 0 in the plane of each joint: T by the cubic law, k(p) the relative conductivity at the
// pressure head p = h - z (relativeConductivity). R_i is the inflow at a node, the sum over its triangles of
// what upstream.h gives, and
// dR_i/dh_j = sum over triangles of (dR_i/dh_j at fixed k + dR_i/dk_j dk/dp(p_j)).

#include <array>
#include <vector>

#include "flow/conditions.h"
#include "flow/sparse.h"
#include "flow/structure.h"
#include "flow/upstream.h"

namespace talus::flow {

/// What the free surface is smeared with. tests/engine/flow/free_surface_test.cpp says how far answers move
/// with each.
struct FreeSurface {
    /// Share of its transmissivity that a joint above the free surface keeps, so that the equations stay
    /// regular. The discharge through the dry part is about this share of that through the wet part.
    double dry_share = 1e-5;
    /// Of a patch's height: the suction at which a joint conducts a half. A wider ramp carries more water
    /// above the free surface; a narrower one takes more steps.
    double ramp = 1.0 / 256;
};

/// Of each node: k, and its slope by the head [1/m].
struct Wetness {
    std::vector<double> conductivity, slope;
};

/// Heads count from a datum, the lowest given head: little is lost to rounding far above sea level.
class Equations {
 public:
    /// \param transmissivity  of each triangle, along its sides 0-1, 1-2, 2-0 [m^2/s]
    Equations(const Network& network, const Conditions& conditions,
              const std::vector<Corners>& transmissivity, const FreeSurface& surface = {});

    double height() const { return network_->height; }  ///< of a patch [m]
    double ramp() const { return ramp_; }               ///< of the answer [m]
    double datum() const { return datum_; }             ///< [m]
    bool isHeld(std::size_t node) const { return held_[node] != 0; }

    /// Puts the given heads, and the elevations of outlets that are open, into these.
    void hold(Vector& heads) const;
    /// Closes outlets that would draw water in, opens closed ones under pressure. \return whether any was
    bool switchOutlets(const Vector& heads, const Vector& inflow);
    void openOutlets();
    /// Opens those whose pressure is not below zero, closes the others.
    void openOutlets(const Vector& heads);

    Wetness full() const;  ///< k = 1 everywhere
    /// \param ramp  see relativeConductivity [m]
    Wetness wetnessOf(const Vector& heads, double ramp) const;
    /// Mean k of the corners of each triangle.
    std::vector<double> sharesOf(const Wetness& wetness) const;

    /// Inflow into the network at each node [m^3/s].
    Vector inflows(const Vector& heads, const Wetness& wetness) const;
    /// Derivative of the inflows by the heads; rows of held nodes are the identity's.
    SparseMatrix derivative(const Vector& heads, const Wetness& wetness) const;
    /// Adds to the diagonal of each unknown this multiple of the conductances about its node, of full joints.
    void addStorage(double multiple, SparseMatrix& matrix) const;
    /// Nodes that would pass the whole ramp on their way stop in its middle, where k has a slope.
    void stopInRamp(const Vector& from, double ramp, Vector& to) const;

    /// Largest inflow at a node that is not held, over the sum of those that enter at held nodes. Infinite
    /// where an inflow is no number.
    double imbalance(const Vector& inflow) const;
    /// Whether that is as small as it gets: a share of the inflow, or all that rounding of the heads leaves.
    bool isBalanced(const Vector& heads, const Vector& inflow) const;
    /// Whether there are no differences of head to speak of.
    bool isStill(const Vector& heads) const;

 private:
    double heldHead(std::size_t node) const;
    double pressureHead(const Vector& heads, std::int32_t node) const;
    TriangleFlow flowIn(std::size_t triangle, const Vector& heads, const Wetness& wetness) const;
    bool isRounding(const Vector& heads, const Vector& inflow) const;
    void add(std::size_t triangle, std::size_t row, std::size_t column, double value,
             SparseMatrix& matrix) const;
    SparseMatrix identityOfHeld() const;

    const Network* network_;
    const Conditions* conditions_;
    double dry_share_, ramp_;
    std::vector<Corners> stiffness_;  ///< conductance between corners 0-1, 1-2, 2-0 [m^2/s]
    Vector around_;                   ///< conductances about each node, their amounts summed [m^2/s]
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

/// Conductance of each side of a triangle: c_ij T_ij, with c_ij = -A grad N_i . grad N_j.
///
/// Where an aperture is linear in the plane and the head changes along its slope alone, q = -T(b) dh/dx is one
/// number, and T_ij (h_i - h_j) = q (x_j - x_i) holds along every side (taperedTransmissivity). Such flow
/// balances as a linear head does in a joint of one aperture, so heads at nodes are exact on any mesh. It is
/// the exponential fitting of Scharfetter and Gummel (1969, IEEE Transactions on Electron Devices 16, 64).
/// The side opposite to an obtuse angle has c < 0. Its T is at most that of the path through the obtuse corner,
/// (c_a + c_b) / (c_a / T_b + c_b / T_a). Then no heads give a negative dissipation. The two are equal where the
/// aperture changes along that side alone.
Corners conductancesOf(const Gradients& gradients, const Corners& transmissivity);

}  // namespace talus::flow
