#pragma once
// The forces on the free blocks of a state and their derivative by the blocks' poses, as a system of
// equations.
//
// Unknowns are six a free block: displacement, and rotation times the block's radius; equations are force,
// and torque over that radius. So all have one unit each, and a torque counts as in outOfBalanceRatio.

#include <cstdint>
#include <vector>

#include "equilibrium/block_matrix.h"
#include "forces/sum.h"
#include "forces/wrench.h"
#include "state/arrays.h"

namespace talus::equilibrium {

/// Trial poses of the blocks; the state keeps poses and plastic slides of the last committed step.
struct Poses {
    PositionArray position;
    QuaternionArray orientation;
    std::vector<Mat3> turn;  ///< the orientations as matrices
};

/// One interface between two blocks of which at least one moves.
struct ActiveInterface {
    std::size_t interface = 0, block_a = 0, block_b = 0;
    std::size_t slot = 0;    ///< in Interfaces
    std::int32_t edge = -1;  ///< of the matrix, when both blocks move
    bool a_first = false;    ///< whether a's row comes before b's
};

/// A tie between two blocks beside contacts (forces/sum.h).
struct ActiveTie {
    const TyingForce* force = nullptr;
    std::size_t tie = 0, block_a = 0, block_b = 0;
    std::int32_t edge = -1;  ///< as of an interface
    bool a_first = false;
};

struct Balance {
    std::vector<std::int32_t> row{};                 ///< of each block, -1 when it does not move
    std::vector<std::size_t> block{};                ///< of each row
    std::vector<double> weight{}, radius{}, size{};  ///< of each row's block [N, m, m]
    std::vector<double> drag{};                      ///< stiffness of the joints on each row's block [N/m]
    std::vector<Vec3> own_force{},
        own_moment{};  ///< of the applied forces that turn with it, in the block's own frame [N, N m]
    std::vector<DeadForce> dead{};         ///< of those that keep their direction; empty where there are none
    std::vector<double> inverse_radius{};  ///< of each block, for the kernel [1/m]
    std::vector<ActiveInterface> interfaces{};  ///< in the order of their slots
    std::vector<ActiveTie> ties{};
    std::vector<InterfaceWrench> wrenches{};     ///< by slot, of the last forces summed
    std::vector<double> carries{}, stiffness{};  ///< likewise; see ResponseView
    BlockMatrix matrix{};                        ///< of the structure of these interfaces and ties
};

/// Reads blocks and interfaces. Idle places are left out.
/// \param moving  by block: which of the free ones move, the others stay where they are; empty: all
Balance makeBalance(const State& state, const std::vector<char>& moving = {});

/// Forces on blocks beside contacts and body forces, as last computed.
void readApplied(const State& state, Balance& balance);

Poses posesOf(const State& state);
void setPoses(const Poses& poses, State& state);

/// Moves blocks by share times the unknowns.
void move(const Balance& balance, const Vec6s& by, double share, Poses& poses);

/// Sum of weight, water and contacts on each row's block; with `stiffness`, minus its derivative into
/// balance.matrix. The memory of contact points is that of the state.
/// \param contacts  whether those of contacts count: not where only differences between loads matter
void sumForces(const State& state, Balance& balance, const Poses& poses, bool stiffness, Vec6s& force,
               bool contacts = true);

}  // namespace talus::equilibrium
