#pragma once
// The forces on the free blocks of a state and their derivative by the blocks' poses, as a system of equations.
//
// Unknowns are six a free block: displacement, and rotation times the block's radius; equations are force, and torque
// over that radius. So all have one unit each, and a torque counts as in outOfBalanceRatio.

#include <cstdint>
#include <vector>

#include "equilibrium/block_matrix.h"
#include "equilibrium/interface_response.h"
#include "forces/sum.h"
#include "forces/wrench.h"
#include "state/arrays.h"

namespace talus::equilibrium {

/// Where the blocks are while a step is sought; the state keeps the poses of the last committed step.
struct Poses {
    PositionArray position;
    QuaternionArray orientation;
    std::vector<Mat3> turn;  ///< the orientations as matrices
};

/// One interface between two blocks of which at least one moves.
struct ActiveInterface {
    InterfacePlace place;
    std::size_t interface = 0, block_a = 0, block_b = 0;
    std::int32_t joint = 0;
    std::size_t first_point = 0, points = 0;
    std::int32_t edge = -1;  ///< of the matrix, when both blocks move
    bool a_first = false;    ///< whether a's row comes before b's
};

/// What ties two blocks beside contacts (forces/sum.h).
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
    std::vector<DeadForce> dead{};  ///< of those that keep their direction; empty where there are none
    std::vector<ActiveInterface> interfaces{};
    std::vector<SolverPoint> points{};
    std::vector<ActiveTie> ties{};
    BlockMatrix matrix{};  ///< of the structure of these interfaces and ties
};

/// Reads interfaces, contact points and what they remember. Idle slots are left out.
Balance makeBalance(const State& state);

/// Takes over what the contact points of a state remember, the interfaces being the same.
void readMemory(const State& state, Balance& balance);
void writeMemory(const Balance& balance, State& state);
/// Forces on blocks beside contacts and what follows their mass, as last computed.
void readApplied(const State& state, Balance& balance);

Poses posesOf(const State& state);
void setPoses(const Poses& poses, State& state);

/// Moves blocks by share times the unknowns.
void move(const Balance& balance, const Vec6s& by, double share, Poses& poses);

/// Sum of weight, water and contacts on each row's block; with `stiffness`, minus its derivative into balance.matrix.
/// \param rounding see normalResponse [N]
void sumForces(const State& state, Balance& balance, const Poses& poses, double rounding, bool stiffness,
               Vec6s& force);

/// Commits the plastic slides of the rounded law into the balance's points.
void commitRounded(const State& state, Balance& balance, const Poses& poses, double rounding);

/// Largest change of slide or gap at an interface's contact points between two sets of poses [m].
double relativeMotion(const Balance& balance, const ActiveInterface& interface, const Poses& from,
                      const Poses& to);

/// How deep the deepest contact point is pressed together [m].
double deepestPoint(const Balance& balance, const Poses& poses);

/// Largest of an array of forces over the weights of their blocks.
double largestRatio(const Balance& balance, const Vec6s& force);

}  // namespace talus::equilibrium
