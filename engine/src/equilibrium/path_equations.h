#pragma once
// The equations of a step from an equilibrium, with one more unknown beside the displacements of the blocks.
//
//   along the path   F(u0 + x, L0 + s) = e C x,      (|x| / d)^2 + (s / l)^2 = 1
//   sliding          F(u0 + x, L0)     = s C x,       |x| = d
//   in pseudo-time   F(u0 + x, L0)     = g S C x
//   at rest          F(u0 + x, L0)     = e C x
//
// x: displacements in the step. s: change of the load, or drag over the stiffness C of the joints on each
// block. F: the out-of-balance forces (balance.h). |x|^2: the sum over blocks of (displacement / size)^2. The
// drag e is so small that at the end of a step it is a twentieth of the accuracy: it only keeps the matrix
// regular. Arc length with the load as an unknown: E. Riks, Int. J. Solids Struct. 15, 1979; M. A. Crisfield,
// Comput. Struct. 13, 1981.
//
// In pseudo-time, blocks move against a given drag g: one step of backward Euler on C du/dt = F(u), of the
// length 1 / g (C. T. Kelley, D. E. Keyes, SIAM J. Numer. Anal. 35, 1998). S slows the blocks that keep
// Newton's method from converging: each block has a pseudo-time of its own.

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "equilibrium/balance.h"
#include "equilibrium/first_order_gaps.h"
#include "equilibrium/linear_solver.h"
#include "talus/search_rules.h"

namespace talus::equilibrium {

/// A load that can be changed.
struct Loading {
    std::function<void(State&, double load)> apply;
    double cell = 0;       ///< width of the wanted bracket, the unit of load steps
    double imbalance = 0;  ///< out-of-balance force over the weight that a change by one cell amounts to
    bool changes_strength = false;  ///< else contact forces follow from the poses alone
};

enum class Unknown : std::uint8_t { load, drag, none };

/// The arc on which a step ends.
struct Arc {
    Unknown unknown = Unknown::load;
    double displacement = 0;  ///< d above; infinite: only the load counts
    double load = 0;          ///< l above
    double drag = 0;          ///< g above; 0: e
};

/// A step, or a guess of one.
struct PathStep {
    Unknown unknown = Unknown::load;
    bool converged = false;
    int iterations = 0;
    Vec6s x{};         ///< displacements, as the unknowns of Balance
    double value = 0;  ///< s above

    explicit operator bool() const { return converged; }
};

/// What has been computed.
struct PathWork {
    std::int64_t steps = 0, factors = 0, forces = 0;
};

/// Forces and stiffness about a state at a load. Writes the state's load and its water at that load.
class PathEquations {
 public:
    PathEquations(State& state, FirstOrderGaps& gaps, const SearchRules& rules, const std::atomic<bool>* stop,
                  PathWork& work);

    /// Sets the load to vary, and its value.
    void setLoading(Loading loading, double load);
    /// Takes contacts, poses and applied forces of the state as they are now.
    void take(const std::vector<char>& moving = {});
    /// After a step that left the contacts as they were.
    void takePoses(Poses poses);
    void setLoad(double load);

    const Balance& balance() const { return balance_; }
    const Poses& poses() const { return poses_; }  ///< u0
    double load() const { return load_; }          ///< L0
    const Loading& loading() const { return loading_; }

    double dot(const Vec6s& x, const Vec6s& y) const;
    double norm(const Vec6s& x) const;
    /// Poses after a step.
    Poses moved(const Vec6s& x) const;

    /// Out-of-balance force less the drag of a step. \param stiffness into the matrix, too; gaps are then of
    /// first order at these poses
    void residual(const Arc& arc, const PathStep& at, const Poses& poses, bool stiffness, Vec6s& force);
    /// Its derivative by s. \param poses of `at`
    void byUnknown(const Arc& arc, const PathStep& at, const Poses& poses, Vec6s& rate);
    /// The largest residual of a block, over the one that a step may end with.
    double inaccuracy(const Vec6s& force) const;
    double inaccuracy(std::size_t row, const Vec6& force) const;
    /// The root of the sum of squares over the weights.
    double merit(const Vec6s& force) const;
    /// Out-of-balance force over the weight that a row's block may have in equilibrium: larger for a thin
    /// block or one far from the origin, by rounding of its coordinates.
    double limitOf(std::size_t row) const;

    /// The fewest rows with nearly all of a residual. \return empty where it is not finite
    std::vector<std::size_t> worstRows(const Vec6s& force) const;

    /// On a row's block, over its displacement [N/m].
    double drag(const Arc& arc, const PathStep& at, std::size_t row) const;
    /// Over C: e above, for steps of that displacement.
    double leastDrag(double displacement) const;
    /// More drag on some rows' blocks in pseudo-time; and a share of that on all from now on.
    void slow(const std::vector<std::size_t>& rows);
    void recover(double share);

    /// Of the matrix last summed with its stiffness.
    bool factorise(const Arc& arc, const PathStep& at);
    bool solve(Vec6s& x, double accuracy = IterativeSolver::kAccuracy) { return linear_->solve(x, accuracy); }

    const State& state() const { return state_; }
    const SearchRules& rules() const { return rules_; }
    /// From outside, or when it has taken more factorisations than allowed.
    bool stopped() const;
    void limitWork(std::int64_t most_factors) { most_factors_ = most_factors; }

 private:
    double sizeOf(std::size_t row) const;
    void applyLoad(double load);

    State& state_;
    FirstOrderGaps& gaps_;
    Loading loading_{};
    const SearchRules& rules_;
    const std::atomic<bool>* stop_;
    PathWork& work_;
    std::int64_t most_factors_ = std::numeric_limits<std::int64_t>::max();
    Balance balance_{};
    Poses poses_{};
    double load_ = 0;
    std::vector<double> rounding_{};  ///< by row, of the coordinates: out-of-balance force over the weight
    double applied_ = 0;              ///< the load that the state has now
    bool water_follows_ = false;      ///< water's forces follow from the load
    double heaviest_drag_ = 0;        ///< C size / weight, the largest of any block
    std::vector<double> slowed_{};    ///< by block: S above
    std::optional<LinearSolver> linear_{};
    std::vector<std::pair<std::int32_t, std::int32_t>> edges_{};  ///< of the matrices that solver takes
};

}  // namespace talus::equilibrium
