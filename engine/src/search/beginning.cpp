#include "search/beginning.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "equilibrium/release.h"

namespace talus::search {
namespace {

using equilibrium::EquilibriumPath;
using equilibrium::Released;

constexpr double kNoLoad = 1e-12;  // [rad], or of the weight
// Attempts to apply the weight, each with more strength than the last.
constexpr int kWeightAttempts = 3;
constexpr double kPartsLess = 0.5;
// Failure displacements. Blocks that part farther slide: the attempt is given up, and the greatest strength is
// tried. Only in that last attempt are blocks followed until they have fallen, several hundred times as far.
constexpr double kSlides = 5;

PathResult resultOf(Released released) {
    switch (released) {
        case Released::rests:
            return PathResult::reached;
        case Released::left:
            return PathResult::failed;
        case Released::lost:
            break;
    }
    return PathResult::lost;
}

/// A load that grows from nothing to its target, in shares of that.
LoadAxis shareOf(const LoadAxis& axis, double wanted) {
    LoadAxis shares = axis;
    const double size = std::abs(wanted);
    shares.loading.apply = [apply = axis.loading.apply, wanted](State& state, double share) {
        apply(state, share * wanted);
    };
    shares.loading.cell = axis.loading.cell / size;
    shares.longest_step = axis.longest_step / size;
    shares.start = 0;
    shares.stop = 1;
    shares.say = [say = axis.say, wanted](double share) { return say(share * wanted); };
    return shares;
}

class Loader {
 public:
    Loader(EquilibriumPath& path, const Model& model, const Start& start)
        : path_(path), model_(model), start_(start) {}

    Begun run() {
        // A given direction of gravity is that of a site: there is no level ground to begin from.
        double level = model_.gravity.direction ? start_.tilt : 0.0;
        const LoadAxis tilting = tiltAxis(model_, path_.rules());
        path_.vary(tilting.loading, level);
        const auto bare = path_.place();
        if (!weigh()) {
            // A block that falls on level ground may be stable at its tilt.
            if (begun_.result != PathResult::failed || std::abs(start_.tilt - level) < kNoLoad) return begun_;
            path_.goBack(bare);
            level = start_.tilt;
            path_.vary(tilting.loading, level);
            if (!weigh()) return begun_;
        }
        if (start_.weighted && start_.weighted(path_)) {
            watered_.reset();
            if (!bringOn(weightAxis(start_.imbalance), "weight")) return begun_;
        }
        const bool may_be_later = std::abs(start_.tilt - level) > kNoLoad;
        if (!model_.hasWater()) {
            if (weaken() && tilt(tilting, level)) push();
            return begun_;
        }
        // An assembly under water that pushes uphill may need the tilt to be stable.
        const auto dry = path_.place();
        const double dry_factor = begun_.factor;
        bool stands = water();
        const bool parts = parted_ > failureDisplacement();
        stands = stands && weaken();
        if ((!stands || parts) && may_be_later && !path_.stopped()) {
            const Begun wet_begun = begun_;
            const auto wet = path_.place();
            path_.goBack(dry);
            begun_.factor = dry_factor;
            if (weaken() && tilt(tilting, level) && rise()) {
                push();
                return begun_;
            }
            if (!stands || path_.stopped()) return begun_;
            begun_ = wet_begun;
            path_.goBack(wet);
        }
        if (stands && tilt(tilting, level)) push();
        return begun_;
    }

 private:
    /// Applies the weight with more strength than the model's, enough that joints only deform elastically and that
    /// water can be applied afterwards. An attempt that parts blocks by more than kSlides is given up for the greatest
    /// strength. Where more strength does not halve the parting, joints had to close, and the earlier attempt counts.
    bool weigh() {
        const auto bare = path_.place();
        const auto weighBare = [&](int attempt, double most) {
            if (attempt > 0) path_.goBack(bare);
            return weighWith(start_.factor / std::pow(path_.rules().weight_strength, attempt + 1), most);
        };
        weighted_.reset();
        watered_.reset();
        bool slid = false;
        for (int k = 0; k < kWeightAttempts && !path_.stopped() && !isFirmlyWeighted(); ++k) {
            const double most = mostParting(k);
            if (weighBare(k, most)) continue;
            slid = slid || parted_ > most;
            k = std::max(k, kWeightAttempts - 2);  // blocks that fall even with the most strength always fall
        }
        if (!weighted_ && slid) {
            path_.goBack(bare);
            weighBare(0, kInfinity);
        }
        if (!weighted_ || path_.stopped()) return false;
        path_.goBack(weighted_->place);
        weighted_.reset();
        begun_.result = PathResult::reached;
        return true;
    }

    /// Parting at which an attempt to apply the weight is given up, as it will most likely not be the one chosen.
    double mostParting(int attempt) const {
        if (weighted_) return weighted_->bears_water ? kPartsLess * begun_.parted : kInfinity;
        return attempt + 1 < kWeightAttempts ? kSlides * failureDisplacement() : kInfinity;
    }

    bool isFirmlyWeighted() const {
        return weighted_ && weighted_->bears_water && begun_.parted <= failureDisplacement();
    }
    double failureDisplacement() const { return start_.displacements[start_.counts]; }

    /// Weight and then water, with strengths divided by a factor; kept where that is the best attempt so far.
    /// \param most  as in bringOn
    /// \return whether it stands under its weight
    bool weighWith(double factor, double most) {
        path_.vary(start_.strength.loading, factor);
        if (!bringOn(weightAxis(start_.imbalance), "weight", most)) return false;
        path_.takeAsStated();
        const double parted = parted_;
        auto place = path_.place();
        const bool bears = !model_.hasWater() || bringOn(waterAxis(start_.imbalance), "water");
        if (path_.stopped()) return false;
        const bool is_better = !weighted_ || (bears && !weighted_->bears_water) ||
                               (bears == weighted_->bears_water && parted < kPartsLess * begun_.parted);
        if (!is_better) return true;
        weighted_ = Weighted{std::move(place), bears};
        watered_.reset();
        if (bears && model_.hasWater()) watered_.emplace(path_.place(), parted_);
        begun_.parted = parted;
        begun_.factor = factor;
        return true;
    }

    /// Puts the water on. `weigh` has found its equilibrium already, unless the weight was applied anew.
    bool water() {
        if (!watered_) return bringOn(waterAxis(start_.imbalance), "water");
        begun_.stage = "water";
        path_.goBack(watered_->first);
        parted_ = watered_->second;
        return true;
    }

    /// From the strength under which weight was applied to that of the search's beginning.
    bool weaken() {
        if (!start_.weakens) return true;
        begun_.stage = "strength";
        const LoadAxis& axis = start_.strength;
        path_.vary(axis.loading, begun_.factor);
        Follow follow = following(start_.factor, [&](double factor, const char* what) {
            start_.report(axis.say(factor) + ", " + what);
        });
        begun_.followed = followPath(path_, axis, follow);
        begun_.result = begun_.followed.result;
        if (begun_.result != PathResult::reached) return false;
        begun_.factor = start_.factor;
        return true;
    }

    /// At once, against a drag; without equilibrium it is tried again with unbreakable joints.
    /// \param most  parting, less elastic displacement, beyond which it is given up [median block sizes]
    /// \return whether it reaches equilibrium
    bool bringOn(const LoadAxis& axis, const char* stage, double most = kInfinity) {
        begun_.stage = stage;
        start_.report(stage);
        path_.vary(axis.loading, 0);
        const equilibrium::Parting since = path_.parting();
        const auto before = path_.place();
        const double fallen = path_.rules().fallen;
        const auto isGivenUp = [&] { return std::isfinite(most) && settlement(since) > most; };
        begun_.result = resultOf(equilibrium::release(path_, 1, since, fallen, isGivenUp));
        if (begun_.result != PathResult::reached && !path_.stopped() && !isGivenUp()) {
            path_.goBack(before);
            begun_.result = resultOf(equilibrium::releaseFromHeldJoints(path_, 1, since, fallen, isGivenUp));
        }
        if (path_.stopped()) begun_.result = PathResult::interrupted;
        parted_ = settlement(since);
        return begun_.result == PathResult::reached;
    }

    /// Parting of neighbours, less elastic displacement [median block sizes].
    double settlement(const equilibrium::Parting& since) const {
        const double gives = (path_.rules().elastic_parting * path_.elasticDisplacement()) /
                             path_.state().geometry->length_scale;
        return path_.partedSince(since) - gives;
    }

    bool follow(const LoadAxis& axis, double wanted, double rise, const char* stage) {
        begun_.stage = stage;
        if (std::abs(wanted) < kNoLoad) return true;
        const LoadAxis shares = shareOf(axis, wanted);
        path_.vary(shares.loading, 0);
        Follow follow = following(
            1, [&](double share, const char* what) { start_.report(shares.say(share) + ", " + what); });
        follow.rise = rise / std::abs(wanted);
        begun_.followed = followPath(path_, shares, follow);
        begun_.result = begun_.followed.result;
        return begun_.result == PathResult::reached;
    }

    Follow following(double target, std::function<void(double, const char*)> report) const {
        return {.target = target,
                .displacements = start_.displacements,
                .counts = start_.counts,
                .mends = start_.mends,
                .report = std::move(report)};
    }

    bool tilt(const LoadAxis& tilting, double level) {
        LoadAxis from_level = tilting;
        from_level.loading.apply = [apply = tilting.loading.apply, level](State& state, double by) {
            apply(state, level + by);
        };
        return follow(from_level, start_.tilt - level, start_.rise, "tilt");
    }

    /// Water applied after the tilt: blocks that it parts on a slope have failed.
    bool rise() {
        const LoadAxis axis = waterAxis(start_.imbalance);
        return follow(axis, 1, path_.rules().rise * axis.loading.cell, "water");
    }

    bool push() {
        return follow(accelerationAxis(model_, path_.rules()), start_.horizontal, start_.rise,
                      "horizontal load");
    }

    EquilibriumPath& path_;
    const Model& model_;
    const Start& start_;
    Begun begun_{};
    double parted_ = 0;
    /// Under the weight, with the best attempt so far.
    struct Weighted {
        EquilibriumPath::Place place;
        bool bears_water;
    };
    std::optional<Weighted> weighted_{};
    std::optional<std::pair<EquilibriumPath::Place, double>> watered_{};  ///< the end of `weigh`, and parted_
};

}  // namespace

Begun bringToStart(EquilibriumPath& path, const Model& model, const Start& start) {
    return Loader(path, model, start).run();
}

}  // namespace talus::search
