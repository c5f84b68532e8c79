#include "talus/searches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "checks/loose_blocks.h"
#include "model/gravity.h"
#include "state/caller.h"

namespace talus {

namespace {

constexpr double kDegree = 0.017453292519943295;  // [rad]

std::optional<TheoryFigure> theoryOfTilt(const Model& model, const std::atomic<bool>*) {
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

/// The strength reduction at which the predicted critical tilt is the model's own tilt. Nothing where no
/// formula applies, or where overturning governs, which does not depend on strength. The formulas may not
/// apply to strong joints (columns lean) or to weak ones (water pushes uphill). So the first factor that
/// slides is sought upwards.
std::optional<TheoryFigure> theoryOfFactor(const Model& model, const std::atomic<bool>* stop) {
    constexpr double kLowest = 0.02, kHighest = 50, kRatio = 1.05;
    ReducedTheory theory(model);
    if (theory.slides(kLowest)) return std::nullopt;  // whatever the strength: nothing to divide
    double high = kLowest;
    while (high < kHighest && !isStopped(stop) && !theory.slides(high)) high *= kRatio;
    double low = high / kRatio;
    while (high / low > 1 + 1e-13 && !isStopped(stop)) {
        const double middle = 0.5 * (low + high);
        (theory.slides(middle) ? high : low) = middle;
    }
    if (isStopped(stop)) return std::nullopt;
    auto prediction = theory.at(high);
    if (prediction) prediction->formula = "with strengths divided by it: " + prediction->formula;
    const bool at_limit =
        prediction && !prediction->topples && std::abs(prediction->critical_tilt - theory.tilt()) < 1e-9;
    return at_limit ? std::optional(TheoryFigure{high, *prediction}) : std::nullopt;
}

/// Without water and cohesion only the direction of the loads matters. On a slope at tilt b an earthquake of
/// k_h and k_v adds a tilt of atan(k_h / (1 - k_v)).
std::optional<TheoryFigure> theoryOfAcceleration(const Model& model, const std::atomic<bool>*) {
    const bool cohesive = std::any_of(model.joints.begin(), model.joints.end(), [](const Joint& joint) {
        return joint.cohesion > 0 || joint.residual_cohesion > 0 || joint.tensile_strength > 0;
    });
    const Seismic& seismic = model.seismic;
    const bool downhill = (pushOf(seismic, model.gravity, 0) + Vec3::UnitX()).norm() < 1e-12;
    if (cohesive || !downhill || model.hasWater() || !(seismic.vertical < 1)) return std::nullopt;
    Model still = model;
    still.seismic = {};
    still.analysis.start.reset();  // the question is about this tilt, not about where a search starts
    auto prediction = theory::predict(still);
    const double more = prediction ? prediction->critical_tilt - model.gravity.tilt : -1.0;
    if (more < 0 || more >= 90 * kDegree) return std::nullopt;
    prediction->formula = "k = (1 - k_v) tan(beta_c - beta), beta_c from: " + prediction->formula;
    return TheoryFigure{(1 - seismic.vertical) * std::tan(more), std::move(*prediction)};
}

constexpr double inDegrees(double radians) { return radians / kDegree; }

/// A search of the tilted model starts and ends where it did.
void tilt(Model& model, double value) {
    model.analysis.start = model.analysis.start.value_or(model.gravity.tilt);
    model.gravity.tilt = value;
}

/// A value derived from a scenario's `gravity.direction`.
double turnedInto(const Model& m) { return m.gravity.direction ? m.gravity.tilt : 0.0; }

template <int Axis>
std::optional<double> directionAlong(const Model& m) {
    if (!m.gravity.direction) return std::nullopt;
    return downward(m.gravity, m.gravity.tilt)[Axis];
}

constexpr std::array kTiltWritten{
    ScenarioNumber{"analysis", "start_deg", -1,
                   [](const Model& m) -> std::optional<double> {
                       return inDegrees(m.analysis.start.value_or(m.gravity.tilt) - turnedInto(m));
                   }},
    ScenarioNumber{
        "analysis", "stop_deg", -1,
        [](const Model& m) -> std::optional<double> { return inDegrees(m.analysis.stop - turnedInto(m)); }},
    ScenarioNumber{"gravity", "tilt_deg", -1,
                   [](const Model& m) -> std::optional<double> {
                       if (m.gravity.direction) return std::nullopt;
                       return inDegrees(m.gravity.tilt);
                   }},
    ScenarioNumber{"gravity", "direction", 0, directionAlong<0>},
    ScenarioNumber{"gravity", "direction", 1, directionAlong<1>},
    ScenarioNumber{"gravity", "direction", 2, directionAlong<2>}};

void shake(Model& model, double horizontal) { model.seismic.horizontal = horizontal; }

constexpr std::array kSeismicWritten{
    ScenarioNumber{"seismic", "horizontal", -1,
                   [](const Model& m) -> std::optional<double> { return m.seismic.horizontal; }}};

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
                                                .text = "horizontal acceleration over gravity",
                                                .key = "horizontal",
                                                .unit = "",
                                                .of = "of the weight",
                                                .scale = 1,
                                                .decimals = 4,
                                                .limit_decimals = 5,
                                                .give = 0.05 * kDegree,
                                                .give_is_share = false,
                                                .apply = shake,
                                                .divides_strengths = false,
                                                .written = kSeismicWritten}};

}  // namespace

const VariedQuantity& quantityOf(Varied varied) { return kQuantities[static_cast<std::size_t>(varied)]; }
std::span<const VariedQuantity> variedQuantities() { return kQuantities; }

namespace {

const std::array kSearches{
    LoadSearch{.name = "critical-angle",
               .about = "The tilt at which the assembly first fails",
               .details = "The search runs from analysis.start_deg to analysis.stop_deg until the bracket is "
                          "analysis.tolerance_deg wide.\nA slope that fails at the start, or is stable up to "
                          "stop_deg, is a result (exit code 0). An undecided search is\nnot (exit code 3).",
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
        .theory = theoryOfFactor},
    LoadSearch{.name = "critical-acceleration",
               .about = "The pseudo-static horizontal acceleration at which the assembly first fails",
               .details = "Each free block carries a horizontal force towards seismic.direction_deg: the "
                          "coefficient times its weight. The\ntilt is the scenario's, and water does not "
                          "change. The search starts at seismic.horizontal (default 0).",
               .answer = "critical k",
               .answer_key = "critical_k",
               .theory_key = "theory_k",
               .load = &quantityOf(Varied::horizontal),
               .lowest = 0,
               .highest = kInfinity,
               .threshold = std::nullopt,
               .follows_groups = false,
               .find = criticalAcceleration,
               .theory = theoryOfAcceleration}};

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

std::vector<std::string> leftOut(const SearchResult& result) {
    std::vector<std::string> names = result.fallen_at_start;
    for (const BlockGroup& group : result.removed_groups)
        names.insert(names.end(), group.blocks.begin(), group.blocks.end());
    return names;
}

double massShare(const Model& model, const std::vector<std::string>& blocks) {
    return checks::looseShare(model, checks::blocksNamed(model, blocks));
}

void putUnderLoad(Model& model, Varied load, double value) { quantityOf(load).apply(model, value); }

}  // namespace talus
