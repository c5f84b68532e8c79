#include "support/consistency.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "support/models.h"
#include "talus/analysis.h"
#include "talus/limit_analysis.h"
#include "talus/searches.h"
#include "talus/simulation.h"
#include "talus/theory.h"

namespace talus::test {
namespace {

// Far enough from a critical angle that the loading path does not decide: a share of it, and a fixed part.
constexpr double kBesideShare = 0.02, kBeside = 0.1 * M_PI / 180;
constexpr double kAccuracy = 5e-3;  // of a factor or of a share of the weight: three brackets
constexpr double kDiffers = 0.02;
constexpr double kLowTilt = 0.7;  // of the critical angle
constexpr double kStiff = 1e11;   // [Pa/m]: columns hardly lean on their joints
constexpr double kSeconds = 1;
constexpr double kStands = 0.01, kMoves = 0.05;  // median block sizes

std::string text(const char* format, auto... values) {
    char line[200];
    std::snprintf(line, sizeof line, format, values...);
    return line;
}

class Check {
 public:
    Check(const Model& model, bool with_history) : model_(model), with_history_(with_history) {
        model_.analysis.start = 0;
        model_.analysis.stop = radians(80);
        // Small failures that are taken out one by one make up another slope than those that go together.
        model_.analysis.least_mass_share = 0;
    }

    Consistency run() {
        const auto angle = criticalAngle(model_, control_);
        if (!angle.ok()) {
            found_.undecided.push_back(angle.errors().front().message);
            return std::move(found_);
        }
        hold(*angle, "critical angle");
        // Where blocks fall on level ground the answer is for the others.
        model_ = withoutBlocks(model_, angle->fallen_at_start);
        if (angle->status != SearchStatus::found) {
            found_.answers = toString(angle->status);
            if (angle->status == SearchStatus::unstable_at_start) expectFailure(0);
            if (angle->status == SearchStatus::stable_to_stop) expectStanding(radians(60), 0);
            return std::move(found_);
        }
        const double tilt = angle->answer, beside = std::max(kBesideShare * tilt, kBeside);
        found_.tilt_deg = degrees(tilt);
        found_.answers = text("%.3f deg", degrees(tilt));
        compareUpperBound(model_, *angle, Varied::tilt);
        compareTheory(tilt);
        if (tilt > beside) expectStanding(tilt - beside, tilt);
        expectFailure(tilt + beside);
        if (tilt > 2 * beside) expectStanding(kLowTilt * tilt, tilt);
        if (with_history_) compareHistories(tilt, beside);
        return std::move(found_);
    }

 private:
    Model at(double tilt) const {
        Model model = model_;
        model.gravity.tilt = tilt;
        return model;
    }

    void hold(const SearchResult& result, const std::string& what) {
        if (result.status != SearchStatus::undecided) return;
        found_.undecided.push_back(what + ": " + (result.warnings.empty() ? "" : result.warnings.back()));
    }

    void contradicts(const std::string& what) { found_.contradictions.push_back(what); }

    /// \param tilt  at which the model should stand \param critical  0 where it is not known
    void expectStanding(double tilt, double critical) {
        const Model model = at(tilt);
        const auto factor = safetyFactor(model, control_);
        const auto horizontal = criticalAcceleration(model, control_);
        if (!factor.ok() || !horizontal.ok())
            return contradicts("a model that tilts does not stand up to checks");
        const std::string where = text("at %.3f deg ", degrees(tilt));
        hold(*factor, where + "safety factor");
        hold(*horizontal, where + "critical acceleration");
        found_.answers += text(", %sF %.4f k %.4f", where.c_str(), factor->answer, horizontal->answer);
        if (factor->status == SearchStatus::unstable_at_start ||
            (factor->status == SearchStatus::found && factor->answer < 1 - kAccuracy))
            contradicts(where + text("factor %.4f", factor->answer));
        if (horizontal->status == SearchStatus::unstable_at_start)
            contradicts(where + "critical acceleration: unstable at the start");
        if (factor->status == SearchStatus::found) compareUpperBound(model, *factor, Varied::factor);
        if (horizontal->status != SearchStatus::found) return;
        compareUpperBound(model, *horizontal, Varied::horizontal);
        // The resultant of weight and horizontal load leans by atan(k): a rigid body knows no difference.
        const double equivalent = tilt + std::atan(horizontal->answer);
        if (critical > 0 && std::abs(equivalent - critical) > kDiffers * critical + kBeside)
            found_.differences.push_back(where + text("k is that of %.3f deg", degrees(equivalent)));
    }

    void expectFailure(double tilt) {
        const Model model = at(tilt);
        const auto factor = safetyFactor(model, control_);
        const auto horizontal = criticalAcceleration(model, control_);
        if (!factor.ok() || !horizontal.ok()) return;
        const std::string where = text("at %.3f deg ", degrees(tilt));
        hold(*factor, where + "safety factor");
        hold(*horizontal, where + "critical acceleration");
        found_.answers += text(", %sF %.4f k %.4f", where.c_str(), factor->answer, horizontal->answer);
        if (factor->status == SearchStatus::stable_to_stop ||
            (factor->status == SearchStatus::found && factor->answer > 1 + kAccuracy))
            contradicts(where + text("factor %.4f", factor->answer));
        if (horizontal->status == SearchStatus::found && horizontal->answer > kAccuracy)
            contradicts(where + text("k %.4f", horizontal->answer));
    }

    void compareUpperBound(const Model& model, const SearchResult& found, Varied varied) {
        const auto limit = limitAnalysis(model, varied, control_);
        if (!limit.ok() || limit->status != SearchStatus::found) return;
        const VariedQuantity& quantity = quantityOf(varied);
        const double give = quantity.give_is_share ? quantity.give * limit->upper : quantity.give;
        if (found.low <= limit->upper + give) return;
        contradicts(text("%s %.4f above its upper bound %.4f", quantity.limit, found.low / quantity.scale,
                         limit->upper / quantity.scale));
    }

    double softest() const {
        double softest = kInfinity;
        for (const Joint& joint : model_.joints) softest = std::min(softest, joint.normal_stiffness);
        return softest;
    }

    void compareTheory(double tilt) {
        const auto prediction = theory::predict(model_);
        if (!prediction) return;
        found_.answers += text(" (theory %.3f)", degrees(prediction->critical_tilt));
        const double beyond = tilt - prediction->critical_tilt, most = kDiffers * tilt + kBeside;
        const std::string says = text("theory says %.3f deg", degrees(prediction->critical_tilt));
        // Formulas are for rigid joints; on soft ones columns lean, and topple sooner.
        if (beyond > most || (beyond < -most && softest() >= kStiff))
            contradicts(says);
        else if (beyond < -most)
            found_.differences.push_back(says);
    }

    /// How far a block has moved after a second at a tilt [median block sizes].
    double movedAt(double tilt) {
        Model model = at(tilt);
        model.run.duration = kSeconds;
        const auto result = talus::run(model, control_, RunOutput{});
        if (!result.ok()) return kInfinity;
        double moved = 0;
        for (const Vec3& displacement : result->displacements) moved = std::max(moved, displacement.norm());
        return moved;
    }

    void compareHistories(double tilt, double beside) {
        double size = kInfinity;
        for (const Block& block : model_.blocks) {
            if (block.motion != Motion::free) continue;
            Eigen::AlignedBox3d box;
            for (const Vec3& v : block.shape.vertices) box.extend(v);
            size = std::min(size, box.sizes().minCoeff());
        }
        const double below = movedAt(tilt - beside) / size, above = movedAt(tilt + beside) / size;
        if (tilt > beside && below > kStands)
            found_.differences.push_back(text("a run moves by %.3f just below", below));
        if (above < kMoves) found_.differences.push_back(text("a run moves by %.4f just above", above));
    }

    Model model_;
    bool with_history_;
    Control control_{.interval = false, .upper_bound = Beside::never};
    Consistency found_{};
};

}  // namespace

Consistency checkConsistency(const Model& model, bool with_history) {
    return Check(model, with_history).run();
}

}  // namespace talus::test
