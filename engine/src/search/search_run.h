#pragma once
// One search in progress: its input, model and results so far. search.cpp has its course, search_result.cpp
// the result, search_beside.cpp the secondary answers.

#include <atomic>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "build/build.h"
#include "equilibrium/equilibrium_path.h"
#include "forces/coupled_flow.h"
#include "search/beginning.h"
#include "search/load_axis.h"
#include "search/path_follower.h"
#include "search/unloaded_joints.h"
#include "state/arrays.h"
#include "talus/analysis.h"
#include "talus/model.h"
#include "talus/result.h"
#include "talus/search_rules.h"

namespace talus::search {

using equilibrium::EquilibriumPath;

/// The end of a path.
struct Course {
    std::unique_ptr<EquilibriumPath> path{};
    Begun begun{};
    Followed followed{};
    double factor = 1;  ///< at which it began
    bool is_followed = false;
};

class Search {
 public:
    Search(Varied varied, const Model& model, const Control& control, const SearchRules& rules)
        : Search(varied, keptByCaller(model), control, rules) {}
    Search(Varied varied, std::shared_ptr<const Model> model, const Control& control,
           const SearchRules& rules)
        : varied_(varied),
          kept_(std::move(model)),
          model_(*kept_),
          control_(control),
          rules_(rules),
          gone_(model_.blocks.size(), 0) {
        tellDisplacements();
    }

    Result<SearchResult> run();
    /// Of coupled flow, where the search begins.
    Result<SteadyFlow> flowAtBeginning();

 private:
    const LoadAxis& axis() const { return *axis_; }

    void tellDisplacements();
    LoadAxis axisOf(const Model& model) const;

    /// The model without the removed blocks, its state and its errors.
    std::vector<Error> build();
    void warnOfLooseBlocks();
    void stopDrivenBlocks();
    void report(const std::string& stage, double fraction, const std::string& detail) const;

    double startTilt() const { return varied_ == Varied::tilt ? axis().start : rest_->gravity.tilt; }
    double startHorizontal() const {
        return varied_ == Varied::horizontal ? axis().start : rest_->seismic.horizontal;
    }
    bool isLevel() const { return rest_->gravity.direction || std::abs(startTilt()) < kNoTilt; }

    /// A path that begins with strengths divided by a factor.
    /// \param weakens to that, after the weight was applied with more strength
    Course beginAt(double factor, bool weakens = true);

    /// A slope that fails before its own tilt is tilted with more strength, as little as possible.
    Course begin();

    /// Blocks that fall under their weight whatever the strength are removed if they are few.
    bool removeFallen(const Course& course);

    /// \param blocks of the remaining model \param count of those taken out so
    bool takeOutOfModel(const std::vector<std::size_t>& blocks, std::size_t* count);

    /// Follows the load that is searched for from where the path began.
    void follow(Course& course);

    /// The slope fails while it is tilted with strengths divided by some factor, but is stable there if
    /// strength is reduced after the tilt. The answer depends on the path: it is the least factor at which
    /// the slope fails during the tilt.
    void narrowBeginnings(Course& course);

    /// \return whether it stands there
    bool raiseTo(Course& course, double target);
    static double progressOf(double load, double from, double target);

    /// Failed blocks of too little mass for an answer are removed from the last equilibrium, and the path
    /// continues.
    /// \param is_answer  of the load that is searched for
    bool letSmallGo(EquilibriumPath& path, const Followed& found, bool is_answer);
    BlockGroup groupOf(const std::vector<std::size_t>& blocks, double load) const;
    void effort(const EquilibriumPath& path);
    Result<SearchResult> interruptedBefore();

    /// From the ends of the paths.
    void finish(Course& course);
    void addDisplacements(const Followed& followed);
    void addCoupling(const Course& course);
    /// The same search on a finer mesh of its coupled flow, where joints taper too much for this one; with the
    /// work so far. Null where the mesh is fine enough, or may not be refined.
    std::unique_ptr<Search> withFinerFlow(const Course& course) const;
    /// Its result, where it has an answer. Else the answer of this mesh counts, with a warning.
    std::optional<SearchResult> onFinerMesh(const Course& course);
    Result<SteadyFlow> flowAt(const Course& course);

    /// How it fails, and the state the search ended in.
    void describe(Course& course, bool has_begun);

    /// From the last equilibrium, under the failing load.
    void keepFailing(Course& course, const State& last);
    void nameFallen();
    /// The removed blocks.
    void nameInFlow(SteadyFlow& flow);

    /// Successive failure groups and their factors: failed blocks are removed from the last equilibrium, and
    /// the path continues.
    void addGroups(Course& course);

    /// By limit analysis: of the assembly as built, or as loaded where joints had to close first.
    void addUpperBound(const Course& course);
    Ceiling boundOf(const Course& course);

    /// Joints that carry nothing at the search's beginning, under increased strength: before any slide that
    /// could press them.
    UnloadedJoints unloadedAtFirst();

    /// By block theory, for the blocks that the answer is for; without an answer, whether any can move.
    void addLimitEquilibrium();
    /// The lowest and the highest answer found.
    void addInterval(const Course& course);
    /// From other results on the path to the answer.
    void addBounds();
    /// The lowest answer that another loading path leaves open: joints that carry nothing when the assembly
    /// is first in equilibrium get no friction.
    void addUnloadedJoints(const Course& course);
    /// On an elastic joint a block turns about a pivot inside its edge, and leans before.
    void addElasticity(const Course& course);
    /// Contact points decide as a whole what is open; the closed part of a patch may be less.
    void addClosedParts(const Course& course, bool turns);
    void warnOfOpenCohesion(const Course& course);
    const State& lastEquilibrium(const Course& course) const;
    /// A secondary answer: whether it was found, and differs from the search's by more than is negligible.
    struct OtherAnswer {
        bool is_found = false, differs = false;
        double value = 0;
    };
    /// Of a slightly different model: widens the interval where the answer differs.
    OtherAnswer addAnswerOf(const Model& model, const std::string& what);
    Result<SearchResult> answerOf(const Model& model) const;
    void lowerInterval(double answer, const std::string& reason);

    static constexpr double kNoTilt = 1e-9;               // [rad]
    static constexpr double kLoading = 0.2, kPath = 0.9;  // of the progress
    static constexpr double kLeastMotion = 0.05;          // of the farthest block's
    // Cells beyond the bracket at which a failure is continued: at the peak itself it would take minutes to
    // begin.
    static constexpr double kPlayedBeyond = 8;

    /// Blocks that fall because earlier groups have left, with the load.
    struct Followers {
        std::vector<std::size_t> blocks;
        PositionArray position;
        QuaternionArray orientation;

        void put(Blocks& to) const {
            for (const std::size_t b : blocks) {
                to.position.set(b, position.get(b));
                to.orientation[b] = orientation[b];
            }
        }
    };

    const Varied varied_;
    const std::shared_ptr<const Model> kept_;
    const Model& model_;  ///< of these
    const Control& control_;
    const SearchRules& rules_;
    std::vector<double> displacements_{};
    std::size_t counts_ = 0;
    std::vector<char> gone_;  ///< per block of the model: removed before the search
    std::size_t fallen_ = 0, slivers_ = 0;
    std::shared_ptr<const Model> rest_{};
    std::optional<LoadAxis> axis_{}, strength_{};
    std::optional<State> built_{};
    std::optional<flow_water::CoupledFlow> coupled_{};  ///< where the flow is
    bool parallel_ = false;
    std::optional<State> settled_{};  ///< when the weight was first in equilibrium
    UnloadedJoints unloaded_{};       ///< where the search begins, with more strength
    bool without_friction_ = false;
    bool closed_parts_known_ = false;  ///< the answer with cohesion on closed parts was found
    std::int64_t factors_of_answer_ = 0;
    /// For a secondary answer: its limit of work, counted as in the result, and its interruption.
    std::int64_t most_factors_ = 0;
    std::atomic<bool>* enough_ = nullptr;
    std::optional<Followers> followers_{};  ///< of what was too small to be the answer without them
    bool mends_on_the_way_ = true;          ///< of the loading path: small failures are removed
    double begins_failing_ = kInfinity;  ///< least factor with which the slope fails on its way to its tilt
    double jammed_at_ = -kInfinity;  ///< factor at which it is stable although it fails during the tilt with
                                     ///< that
    equilibrium::PathWork counted_{};  ///< of the path that is followed
    SearchResult result_{};
};

}  // namespace talus::search
