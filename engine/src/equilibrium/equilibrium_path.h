#pragma once
// An assembly on its equilibrium path: the last committed state, steps from there, and return to earlier
// states.

#include <vector>

#include "equilibrium/first_order_gaps.h"
#include "equilibrium/parting.h"
#include "equilibrium/path_equations.h"
#include "forces/coupled_flow.h"
#include "state/arrays.h"
#include "talus/search_rules.h"

namespace talus::equilibrium {

/// The end of a path so far. Steps are tried, then committed: only then do plastic slides, bonds and contacts
/// follow.
class EquilibriumPath {
 public:
    /// \param state  as built, or in equilibrium: gaps exact
    EquilibriumPath(State state, const SearchRules& rules, bool parallel, const std::atomic<bool>* stop);
    EquilibriumPath(const EquilibriumPath&) = delete;
    EquilibriumPath& operator=(const EquilibriumPath&) = delete;

    const State& state() const { return state_; }
    double load() const { return equations_.load(); }
    const Poses& poses() const { return equations_.poses(); }
    const SearchRules& rules() const { return rules_; }
    const PathWork& work() const { return work_; }
    bool stopped() const { return equations_.stopped(); }
    /// It is as if interrupted after so many factorisations.
    void limitWork(std::int64_t most_factors) { equations_.limitWork(most_factors); }
    /// The step committed last; empty after a change of contacts of another kind or a jump.
    const PathStep& last() const { return last_; }

    /// Sets the load to vary.
    void vary(const Loading& loading, double load);
    /// Puts a load on, without looking for equilibrium.
    void putUnder(double load);
    /// Another law for the contacts of some pairs: called with the state after each search for contacts.
    void mark(std::function<void(State&)> marked);

    /// From now on the pressure of flow follows the joints; the path does not own it.
    void couple(flow_water::CoupledFlow* flow) { coupled_ = flow; }
    /// Coupled: apertures are as stated while joints are as open as now.
    void takeAsStated();
    /// Coupled, in equilibrium: see CoupledFlow::renew.
    bool renewPressure();

    /// A step along the path from its end, of the arc's length, or shorter where that does not converge.
    PathStep along(const Arc& arc);
    /// From the end to equilibrium at its load, by Newton's method alone.
    PathStep toRest();
    /// The same for the first load: joints are unbreakable at first, and then weaken step by step.
    PathStep fromHeldJoints();
    /// Moves the end against a drag, the smallest that converges, by `most` [block sizes] between neighbours.
    /// \param most_factors factorisations after which the step is no longer extended
    PathStep against(double most, std::int64_t most_factors);
    /// A step in pseudo-time: blocks move against a drag, by no more than `most` [block sizes] between neighbours.
    /// \param drag over the joints' stiffness; afterwards that of the next step
    PathStep relax(double most, double& drag);

    /// \return whether contacts were searched for
    void commit(PathStep step);
    /// Whether bonds are being released, call by call.
    bool bondsGive() const;
    /// Out-of-balance force over the weight, the largest of any free block, by the exact law.
    double outOfBalance() const;
    bool isBalanced() const;
    /// Largest elastic displacement of a joint, along or across it [m].
    double elasticDisplacement() const;

    /// From now on.
    Parting parting() const { return {state_, equations_.balance(), poses()}; }
    /// How far neighbours have parted, and by a step [median block sizes].
    double partedSince(const Parting& since) const;
    double slidSince(const Parting& since) const;
    double partedAfter(const Parting& since, const PathStep& step) const;
    double partedBy(const PathStep& step) const { return partedAfter(parting(), step); }
    double norm(const PathStep& step) const { return equations_.norm(step.x); }

    /// Removes blocks: they stay where they are, fixed, and touch nothing.
    void takeOut(const std::vector<std::size_t>& blocks);

    /// A copy of the end, to return to.
    struct Place {
        State state;
        FirstOrderGaps gaps;
        Loading loading;
        double load;
        PathStep last;
        std::vector<double> motion;
        double motion_since_search;
    };
    Place place() const;
    void goBack(const Place& place);

    /// The state with exact gaps, for use outside this class.
    State exactState() const;

 private:
    PathStep tryAlong(const Arc& arc);
    PathStep solveLonger(const Arc& arc, PathStep from, double longest);
    void searchContacts();
    void takeContacts();
    void setGaps();

    State state_;
    SearchRules rules_;
    bool parallel_;
    PathWork work_{};
    FirstOrderGaps gaps_;
    PathEquations equations_;
    PathStep last_{};
    std::function<void(State&)> mark_{};
    flow_water::CoupledFlow* coupled_ = nullptr;
    int passes_ = 0;                  ///< of coupled flow, on the way to an equilibrium at the present load
    std::vector<double> motion_{};    ///< of each block since contacts were looked for [m]
    double motion_since_search_ = 0;  ///< the largest, over the block's size
};

}  // namespace talus::equilibrium
