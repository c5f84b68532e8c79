#include "talus/searches.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace talus {

namespace {

constexpr double kDegree = 0.017453292519943295;  // [rad]

std::optional<TheoryFigure> theoryOfTilt(const Model& model) {
    auto prediction = theory::predict(model);
    if (!prediction) return std::nullopt;
    const double tilt = prediction->critical_tilt;
    return TheoryFigure{tilt, std::move(*prediction)};
}

/// The closed formulas at reduced strength, at the model's own tilt.
class ReducedTheory {
 public:
    explicit ReducedTheory(const Model& model)
        : model_(model), joints_(model.joints), tilt_(model.gravity.tilt) {
        model_.analysis.start.reset();  // the question is about this tilt, not about where a search starts
    }

    std::optional<theory::Prediction> at(double factor) {
        model_.joints = joints_;
        putUnderLoad(model_, Varied::factor, factor);
        return theory::predict(model_);
    }
    bool slides(double factor) {
        const auto prediction = at(factor);
        return prediction && !prediction->topples && prediction->critical_tilt <= tilt_;
    }
    double tilt() const { return tilt_; }

 private:
    Model model_;
    std::vector<Joint> joints_;
    double tilt_;
};

/// The strength reduction at which the predicted critical tilt is the model's own tilt. Nothing where no formula
/// applies, and nothing where overturning decides: strength has no part in that. The formulas may be silent for strong
/// joints (columns lean) and for weak ones (water pushes uphill), so the first factor that slides is sought upwards.
std::optional<TheoryFigure> theoryOfFactor(const Model& model) {
    constexpr double kLowest = 0.02, kHighest = 50, kRatio = 1.05;
    ReducedTheory theory(model);
    if (theory.slides(kLowest)) return std::nullopt;  // whatever the strength: nothing to divide
    double high = kLowest;
    while (high < kHighest && !theory.slides(high)) high *= kRatio;
    double low = high / kRatio;
    while (high / low > 1 + 1e-13) {
        const double middle = 0.5 * (low + high);
        (theory.slides(middle) ? high : low) = middle;
    }
    auto prediction = theory.at(high);
    if (prediction) prediction->formula = "with strengths divided by it: " + prediction->formula;
    const bool at_limit =
        prediction && !prediction->topples && std::abs(prediction->critical_tilt - theory.tilt()) < 1e-9;
    return at_limit ? std::optional(TheoryFigure{high, *prediction}) : std::nullopt;
}

const std::array kSearches{
    LoadSearch{.name = "critical-angle",
               .about = "The tilt at which the assembly first fails",
               .details =
                   "The search runs from analysis.start_deg to analysis.stop_deg until the bracket is "
                   "analysis.tolerance_deg wide.\nA slope that fails at the start or stands to the end is a "
                   "result (exit code 0), an undecided one is not (3).",
               .answer = "critical angle",
               .answer_key = "critical_angle_deg",
               .theory_key = "theory_deg",
               .load = Varied::tilt,
               .load_text = "tilt",
               .load_key = "tilt_deg",
               .unit = "deg",
               .scale = kDegree,
               .decimals = 3,
               .lowest = -90,
               .highest = 90,
               .threshold = std::nullopt,
               .find = criticalAngle,
               .theory = theoryOfTilt},
    LoadSearch{
        .name = "safety-factor",
        .about = "Factor of safety by strength reduction, at the scenario's tilt",
        .details =
            "tan(phi) and C of all joints are divided by the factor; the answer is the factor at which "
            "the assembly first fails.",
        .answer = "factor of safety",
        .answer_key = "safety_factor",
        .theory_key = "theory_factor",
        .load = Varied::factor,
        .load_text = "strengths divided by",
        .load_key = "factor",
        .unit = "",
        .scale = 1,
        .decimals = 4,
        .lowest = 0,
        .highest = kInfinity,
        .threshold = 1.0,
        .find = safetyFactor,
        .theory = theoryOfFactor}};

}  // namespace

std::string LoadSearch::keyInUnit(std::string_view key) const {
    return std::string(key) + (*unit == '\0' ? "" : "_") + unit;
}

std::span<const LoadSearch> loadSearches() { return kSearches; }

const LoadSearch* loadSearch(std::string_view name) {
    const auto found = std::find_if(kSearches.begin(), kSearches.end(),
                                    [&](const LoadSearch& search) { return search.name == name; });
    return found == kSearches.end() ? nullptr : &*found;
}

void putUnderLoad(Model& model, Varied load, double value) {
    switch (load) {
        case Varied::tilt:
            model.gravity.tilt = value;
            return;
        case Varied::factor:
            for (Joint& joint : model.joints) joint = reduced(joint, value);
            return;
        case Varied::horizontal:
            return;  // no search varies it
    }
}

}  // namespace talus
