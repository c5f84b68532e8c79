#pragma once
// Probes of a search: a load is changed from where the assembly last stood, and it comes to rest or does not.

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "analysis/load_axis.h"
#include "analysis/quasi_static.h"
#include "talus/analysis.h"

namespace talus::analysis {

/// Factorisations of one implicit solve that is given its time.
inline constexpr std::int64_t kMostFactors = 600;
/// And of one on which hangs whether a failure is one that was not seen to be one: what creeps before it fails takes more.
inline constexpr std::int64_t kPatientFactors = 1'500;
/// And of one in an assembly that stood where it had left that open: the longer a row of columns that lean on each other, the more.
inline constexpr std::int64_t kMostOfAllFactors = 4'800;
/// A block that has gone this share of its size has left its place.
inline constexpr double kSeenShare = 2e-4;

/// What probes start from and what they leave.
struct Probing {
    const LoadAxis& axis;
    const Control& control;
    State last_stable, last_moving;
    QuasiStaticWork work;
    std::vector<Probe> probes{};
    std::int64_t steps = 0, factors = 0;
    std::int64_t most_factors = kMostFactors;  ///< of a probe that the implicit solve is asked first
    TimeSpent time{};
    std::int64_t states_at_rest = 0;  ///< the search has been in
    bool has_stood = false;           ///< under weight and water
    double start_tilt = 0;            ///< [rad]
    double stable_load = 0;           ///< at which it last stood
    double crept = 0;                 ///< in the short load steps since the last longer one [m]
    double deflection = 0;            ///< how far the assembly has come in all, from rest to rest [m]
    double settlement = 0;            ///< under weight and water at the start [m]
    double reach = 0;                 ///< of the bolts at the beginning [m]
    double least_mass = 0;            ///< of a failure that counts [kg]
    bool cuts_back = false;           ///< what the implicit solve leaves open is left so
    bool lets_small_go = false;       ///< a probe ends where blocks of less leave or do not come to rest
    /// explicit steps have not been enough, or will not be: bolts take hold over ways that they are slow to go
    bool implicit_first = false;
    bool stands_elsewhere = false;  ///< an equilibrium was found at the failing load, but far away or jammed
    State elsewhere{};              ///< that one; of blocks that jam one on their way there, were they not to
    /// Those that move with the farthest one in the last failing probe, of weight only in one of the implicit solve; else empty.
    std::vector<std::size_t> leaving{};

    /// Where neighbours part from, of those that yield (`yields` in probing.cpp): where it last stood, or stood some cells before.
    struct Stood {
        double load = 0;
        Blocks blocks{};
    };
    std::optional<Stood> stood_before{};

    bool areMany() const { return last_stable.searches_around; }
    bool hasCrumbs() const;  ///< so many free blocks that some small one is always in the way of a rest

    /// The last load at which the implicit solve found no rest nearby, and from which state: it would find the same again.
    struct NoNearRest {
        double load = -std::numeric_limits<double>::infinity();
        std::int64_t most_factors = 0;
        std::int64_t states_at_rest = 0;
        Verdict verdict = Verdict::failing;  ///< undecided: it used up its factorisations
        bool is_elsewhere = false;
    } no_near_rest{};
};

Probing beginProbing(const State& state, const LoadAxis& axis, const Control& control,
                     const QuasiStatic& settings, bool parallel);

/// Whether the search is to end before it has its answer: its caller stopped it, or its work is used up.
bool interrupted(const Probing& probing);

/// Tells who asked for progress where the search is.
/// \param what  of the load: a verdict, or what is being done
void report(const Probing& probing, const std::string& stage, double load, const std::string& what);

/// One probe from the last stable state; keeps the state it ends in. Explicit steps first, which are quick where
/// blocks slide; what they leave open, and what seems to fail before the assembly has stood, the implicit solve
/// answers. A model that once needed it is asked that way first. Where neither knows, explicit steps go on.
Verdict probe(Probing& probing, const std::string& stage, double load, const Ramp& ramp);

/// What the implicit solve finds at a failing load, given its time: blocks that topple may have been shaken there by the
/// explicit steps. Failing: no rest near, though `stands_elsewhere` may say that there is another.
Verdict restAt(Probing& probing, double load, std::int64_t most_factors);

/// Whether a state that moves at a load comes to rest when it is watched for longer; it is the last stable one then. A
/// mode many times slower than the slowest known one looks like failure for a while: close below the load at which a
/// column topples its stiffness goes to zero. \param watch_periods  windows, in slowest periods
bool settles(Probing& probing, const State& moving, double load, double watch_periods = 3.0);

/// The state that moves at a failing load and what leaves there, to be seen again after probes at other loads.
struct SeenFailing {
    State moving;
    std::vector<std::size_t> leaving;
};
SeenFailing seenFailing(const Probing& probing);
void seeAgain(Probing& probing, SeenFailing seen);

/// Those that left their place in the last probe, or were not at rest at its end, where they are let go: of many blocks, so few that
/// they have too little mass to count, and no bolt ties them; sorted.
std::vector<std::size_t> smallLeaving(const Probing& probing);

/// How far the assembly has come in all, but for the way on which bolts took hold: then what it gave at its start [m].
double ownDeflection(const Probing& probing);

}  // namespace talus::analysis
