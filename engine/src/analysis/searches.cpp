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

constexpr double inDegrees(double radians) { return radians / kDegree; }

/// A search of the tilted model starts and ends where it did.
void tilt(Model& model, double value) {
    model.analysis.start = model.analysis.start.value_or(model.gravity.tilt);
    model.gravity.tilt = value;
}

constexpr std::array kTiltWritten{
    ScenarioNumber{"analysis", "start_deg",
                   [](const Model& m) { return inDegrees(m.analysis.start.value_or(m.gravity.tilt)); }},
    ScenarioNumber{"analysis", "stop_deg", [](const Model& m) { return inDegrees(m.analysis.stop); }},
    ScenarioNumber{"gravity", "tilt_deg", [](const Model& m) { return inDegrees(m.gravity.tilt); }}};

void divideStrengths(Model& model, double factor) {
    if (factor == 1) return;  // to the bit: an angle's tangent and back rounds
    for (Joint& joint : model.joints) joint = reduced(std::move(joint), factor);
}

// In the order of Varied.
constexpr std::array kQuantities{VariedQuantity{.varied = Varied::tilt,
                                                .name = "tilt",
                                                .limit = "critical angle",
                                                .text = "tilt",
                                                .key = "tilt_deg",
                                                .unit = "deg",
                                                .of = "",
                                                .scale = kDegree,
                                                .decimals = 3,
                                                .limit_decimals = 4,
                                                .give = 0.05 * kDegree,
                                                .give_is_share = false,
                                                .apply = tilt,
                                                .divides_strengths = false,
                                                .written = kTiltWritten},
                                 VariedQuantity{.varied = Varied::factor,
                                                .name = "factor",
                                                .limit = "factor of safety",
                                                .text = "strengths divided by",
                                                .key = "factor",
                                                .unit = "",
                                                .of = "",
                                                .scale = 1,
                                                .decimals = 4,
                                                .limit_decimals = 4,
                                                .give = 0.005,
                                                .give_is_share = true,
                                                .apply = divideStrengths,
                                                .divides_strengths = true,
                                                .written = {}},
                                 VariedQuantity{.varied = Varied::horizontal,
                                                .name = "horizontal",
                                                .limit = "horizontal load",
                                                .text = "horizontal load",
                                                .key = "horizontal",
                                                .unit = "",
                                                .of = "of the weight",
                                                .scale = 1,
                                                .decimals = 4,
                                                .limit_decimals = 5,
                                                .give = 0.05 * kDegree,
                                                .give_is_share = false,
                                                .apply = nullptr,
                                                .divides_strengths = false,
                                                .written = {}}};

}  // namespace

const VariedQuantity& quantityOf(Varied varied) { return kQuantities[static_cast<std::size_t>(varied)]; }
std::span<const VariedQuantity> variedQuantities() { return kQuantities; }

namespace {

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
               .load = &quantityOf(Varied::tilt),
               .lowest = -90,
               .highest = 90,
               .threshold = std::nullopt,
               .follows_groups = false,
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
        .load = &quantityOf(Varied::factor),
        .lowest = 0,
        .highest = kInfinity,
        .threshold = 1.0,
        .follows_groups = true,
        .find = safetyFactor,
        .theory = theoryOfFactor}};

}  // namespace

std::string LoadSearch::keyInUnit(std::string_view key) const {
    return std::string(key) + (*load->unit == '\0' ? "" : "_") + load->unit;
}

std::span<const LoadSearch> loadSearches() { return kSearches; }

const LoadSearch* loadSearch(std::string_view name) {
    const auto found = std::find_if(kSearches.begin(), kSearches.end(),
                                    [&](const LoadSearch& search) { return search.name == name; });
    return found == kSearches.end() ? nullptr : &*found;
}

void putUnderLoad(Model& model, Varied load, double value) {
    if (const auto apply = quantityOf(load).apply) apply(model, value);
}

}  // namespace talus
