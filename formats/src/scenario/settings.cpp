#include "scenario/settings.h"

#include <charconv>

#include "scenario/fields.h"

namespace talus::formats::scenario {

namespace {

constexpr double kDefaultStopDeg = 45;
constexpr double kMaxFrames = 1e7;  // of a run: keeps a slip in the units from filling the disk
constexpr double kMaxSteps = 1e12;  // ... or from going on for years
constexpr int kMaxGrid = 64;

// Narrower brackets are below what doubles resolve in a search.
constexpr Interval kToleranceDeg{1e-9, 45, false, false};
constexpr Interval kFactorTolerance{1e-9, 1, false, false};
constexpr Interval kAccelerationTolerance{1e-9, 1, false, false};
constexpr Interval kMassShare{0, 1, false, true};
constexpr double kLeastMassOfRock = 0.01;
constexpr Interval kFailureDisplacement{1e-6, 0.1};

void readDirection(TableReader& table, Gravity& gravity) {
    if (table.has("direction") && table.has("tilt_deg"))
        table.error("direction", "found both direction and tilt_deg, allowed: one of them");
    const auto direction = table.vector("direction", kCoordinate);
    if (!direction) return;
    if (direction->norm() > 0)
        gravity.direction = direction;
    else
        table.error("direction", "found [0, 0, 0], allowed: a vector with a length greater than 0");
}

void readGravity(TableReader& root, Model& model, double& tilt_deg) {
    std::vector<std::string> keys = keysOf(kGravityFields);
    keys.emplace_back("direction");
    auto table = root.table("gravity", std::move(keys));
    if (!table) return;
    readDirection(*table, model.gravity);
    readNumbers(*table, kGravityFields, model.gravity);
    if (const auto node = table->find("tilt_deg"); node && node->isNumber()) tilt_deg = node->number();
}

void checkSearchRange(TableReader& table, double start_deg, double stop_deg) {
    if (start_deg < stop_deg) return;
    const bool has_stop = table.has("stop_deg");
    const std::string start = numberText(start_deg) + (table.has("start_deg") ? "" : " (gravity.tilt_deg)");
    const std::string stop = numberText(stop_deg) + (has_stop ? "" : " (the default)");
    table.error(has_stop ? "stop_deg" : "start_deg",
                "found a search from " + start + " to " + stop + ", allowed: start_deg less than stop_deg");
}

void readAnalysis(TableReader& root, Model& model, double tilt_deg) {
    AnalysisSettings& settings = model.analysis;
    settings.stop = defaultStopDeg(tilt_deg) * kRadPerDeg;
    auto table = root.table(
        "analysis", {"start_deg", "stop_deg", "tolerance_deg", "factor_tolerance", "acceleration_tolerance",
                     "least_mass_share", "failure_displacement", "time_scaling", "reduce_tensile_strength"});
    // In a mass of many blocks the first failure is usually a small block, which is not the failure of
    // interest.
    if (root.has("rock_mass")) settings.least_mass_share = kLeastMassOfRock;
    if (!table) return;
    const auto start_deg = table->number("start_deg", kTiltDeg);
    const auto stop_deg = table->number("stop_deg", kTiltDeg);
    if (start_deg) settings.start = *start_deg * kRadPerDeg;
    if (start_deg || stop_deg) {
        settings.stop = stop_deg.value_or(kDefaultStopDeg) * kRadPerDeg;
        checkSearchRange(*table, start_deg.value_or(tilt_deg), stop_deg.value_or(kDefaultStopDeg));
    }
    if (const auto tolerance_deg = table->number("tolerance_deg", kToleranceDeg))
        settings.tolerance = *tolerance_deg * kRadPerDeg;
    settings.factor_tolerance =
        table->number("factor_tolerance", kFactorTolerance).value_or(settings.factor_tolerance);
    settings.acceleration_tolerance = table->number("acceleration_tolerance", kAccelerationTolerance)
                                          .value_or(settings.acceleration_tolerance);
    settings.least_mass_share =
        table->number("least_mass_share", kMassShare).value_or(settings.least_mass_share);
    settings.failure_displacement =
        table->number("failure_displacement", kFailureDisplacement).value_or(settings.failure_displacement);
    settings.reduce_tensile_strength =
        table->boolean("reduce_tensile_strength").value_or(settings.reduce_tensile_strength);
    settings.time_scaling = table->boolean("time_scaling").value_or(settings.time_scaling);
}

void readRun(TableReader& root, Model& model) {
    auto table = root.table("run", {"duration_s", "time_step_s", "frame_interval_s", "watch", "start"});
    if (!table) return;
    RunSettings& run = model.run;
    run.duration = table->number("duration_s", kDuration).value_or(run.duration);
    run.time_step = table->number("time_step_s", kDuration);
    run.frame_interval = table->number("frame_interval_s", kDuration).value_or(run.frame_interval);
    if (run.time_step && (*run.time_step > 0.5 * run.duration || *run.time_step < run.duration / kMaxSteps)) {
        table->error("time_step_s",
                     "found " + numberText(*run.time_step) + " s in a run of " + numberText(run.duration) +
                         " s, allowed: at most half of it and no more than " + numberText(kMaxSteps) +
                         " steps; if the key is omitted, the step is chosen");
    }
    if (run.duration / run.frame_interval > kMaxFrames)
        table->error("frame_interval_s", "found " + numberText(run.frame_interval) + " s in a run of " +
                                             numberText(run.duration) + " s, allowed: at most " +
                                             numberText(kMaxFrames) + " frames");
    if (const auto start = table->choice("start", {"equilibrium", "unstressed"}))
        run.start = *start == 0 ? RunSettings::Start::equilibrium : RunSettings::Start::unstressed;
    // Whether the watched blocks exist is checked once all blocks are known.
    run.watch = table->texts("watch", std::nullopt).value_or(std::vector<std::string>{});
}

void readNumberSections(TableReader& root, Model& model) {
    eachNumberSection([&](std::string_view section, const auto& fields, auto owner) {
        if (auto table = root.table(section, keysOf(fields))) readNumbers(*table, fields, model.*owner);
    });
}

/// N of "grid N".
std::optional<int> gridSize(const std::string& text) {
    constexpr std::string_view kPrefix = "grid ";
    if (text.compare(0, kPrefix.size(), kPrefix) != 0) return std::nullopt;
    int size = 0;
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data() + kPrefix.size(), end, size);
    if (read.ec != std::errc() || read.ptr != end || size < 1 || size > kMaxGrid) return std::nullopt;
    return size;
}

void readContact(TableReader& root, Model& model) {
    auto table = root.table("contact", {"points"});
    if (!table) return;
    const auto text = table->text("points");
    if (!text) return;
    if (*text == "vertex") {
        model.points = {PointRule::Kind::vertex, 0};
    } else if (*text == "distributed") {
        model.points = {PointRule::Kind::distributed, 0};
    } else if (*text == "quarter") {
        model.points = {PointRule::Kind::quarter, 0};
    } else if (*text == "corner") {
        model.points = {PointRule::Kind::corner, 0};
    } else if (const auto grid = gridSize(*text)) {
        model.points = {PointRule::Kind::grid, *grid};
    } else {
        table->error(
            "points",
            "found " + quoted(*text) +
                R"(, allowed: "vertex", "distributed", "quarter", "corner", or "grid N" with N from 1 to )" +
                std::to_string(kMaxGrid));
    }
}

}  // namespace

double defaultStopDeg(double start_deg) {
    return start_deg < kDefaultStopDeg ? kDefaultStopDeg : (start_deg + 90) / 2;
}

void readSettings(TableReader& root, Model& model) {
    double tilt_deg = 0;
    readGravity(root, model, tilt_deg);
    readAnalysis(root, model, tilt_deg);
    readRun(root, model);
    readNumberSections(root, model);
    readContact(root, model);
}

}  // namespace talus::formats::scenario
