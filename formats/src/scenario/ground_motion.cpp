#include "scenario/ground_motion.h"

#include <algorithm>
#include <array>

#include "files/csv_line.h"
#include "files/number.h"
#include "toml/file_text.h"

namespace talus::formats::scenario {

namespace {

constexpr std::array<const char*, 3> kAccelerations{"ax_m_s2", "ay_m_s2", "az_m_s2"};
constexpr std::array<const char*, 3> kVelocities{"vx_m_s", "vy_m_s", "vz_m_s"};
constexpr const char* kColumns = "time_s and any of ax_m_s2, ay_m_s2, az_m_s2, or of vx_m_s, vy_m_s, vz_m_s";
constexpr std::size_t kMostRows = 10'000'000;

struct Record {
    bool velocities = false;
    std::vector<double> time;
    std::vector<Vec3> value;
};

/// Reads a file's lines; the first fault ends it.
class RecordReader {
 public:
    explicit RecordReader(std::string_view text) : lines_(text) {}

    /// Empty, and `fault` says why.
    std::optional<Record> read(std::string& fault) {
        while (fault_.empty() && lines_.next()) column_.empty() ? readHeader() : readRow();
        if (fault_.empty() && record_.time.size() < 2)
            fault_ = "found " + std::to_string(record_.time.size()) + " rows, allowed: at least 2";
        fault = fault_;
        return fault.empty() ? std::optional(std::move(record_)) : std::nullopt;
    }

 private:
    void refuse(const std::string& what) { fault_ = "line " + std::to_string(lines_.number()) + ": " + what; }

    void readHeader() {
        separator_ = separatorOf(lines_.line());
        bool accelerations = false;
        for (const CsvCell& each : cellsOf(lines_.line(), separator_)) {
            const std::string& cell = each.text;
            const auto among = [&](const auto& names) {
                return static_cast<int>(std::find(names.begin(), names.end(), cell) - names.begin());
            };
            const int a = among(kAccelerations), v = among(kVelocities);
            column_.push_back(cell == "time_s" ? kTime : a < 3 ? a : v < 3 ? v : kUnknown);
            accelerations = accelerations || a < 3;
            record_.velocities = record_.velocities || v < 3;
            if (column_.back() == kUnknown)
                return refuse("found column \"" + cell + "\", allowed: " + kColumns);
        }
        std::vector<int> sorted = column_;
        std::sort(sorted.begin(), sorted.end());
        if (sorted.front() != kTime || sorted.size() < 2 || accelerations == record_.velocities ||
            std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
            refuse("found columns \"" + std::string(withoutBlanks(lines_.line())) +
                   "\", allowed: " + kColumns + ", each once");
    }

    void readRow() {
        const std::vector<CsvCell> cells = cellsOf(lines_.line(), separator_);
        if (const std::string wrong = rowFault(cells, column_.size(), separator_); !wrong.empty())
            return refuse(wrong);
        double time = 0;
        Vec3 value = Vec3::Zero();
        for (std::size_t k = 0; k < cells.size(); ++k) {
            const auto number = numberOf(cells[k].text);
            if (!number)
                return refuse(cells[k].text.empty() ? "found a gap, allowed: a number in each column"
                                                    : "found \"" + cells[k].text + "\", allowed: a number");
            (column_[k] == kTime ? time : value[column_[k]]) = *number;
        }
        if (!record_.time.empty() && time <= record_.time.back())
            return refuse("found the time " + numberText(time) + " s after " +
                          numberText(record_.time.back()) + " s, allowed: increasing times");
        if (time < 0) return refuse("found the time " + numberText(time) + " s, allowed: at least 0");
        if (record_.time.size() == kMostRows)
            return refuse("found more than " + std::to_string(kMostRows) +
                          " rows, allowed: at most this number");
        record_.time.push_back(time);
        record_.value.push_back(value);
    }

    static constexpr int kTime = -1, kUnknown = 3;
    CsvLines lines_;
    char separator_ = ',';
    std::vector<int> column_{};
    Record record_{};
    std::string fault_{};
};

/// Accelerations, linear in between; between velocities they are constant, and jump.
GroundMotion motionOf(const Record& record, double scale) {
    GroundMotion motion;
    const auto add = [&](double time, const Vec3& acceleration) {
        motion.time.push_back(time);
        motion.acceleration.push_back(scale * acceleration);
    };
    for (std::size_t k = 0; k < record.time.size(); ++k) {
        if (!record.velocities) {
            add(record.time[k], record.value[k]);
            continue;
        }
        if (k + 1 == record.time.size()) break;
        const Vec3 slope = (record.value[k + 1] - record.value[k]) / (record.time[k + 1] - record.time[k]);
        add(record.time[k], slope);
        add(record.time[k + 1], slope);
    }
    return motion;
}

/// Integrals over time of a piecewise linear quantity times 1 and time (trapezoids; exact for the first).
struct TimeMoments {
    Vec3 zeroth = Vec3::Zero(), first = Vec3::Zero();
};

TimeMoments momentsOf(const GroundMotion& motion) {
    TimeMoments sum;
    const double start = motion.time.front();
    for (std::size_t k = 0; k + 1 < motion.time.size(); ++k) {
        const double from = motion.time[k] - start, to = motion.time[k + 1] - start, step = to - from;
        const Vec3 &a = motion.acceleration[k], &b = motion.acceleration[k + 1];
        sum.zeroth += 0.5 * step * (a + b);
        sum.first += step / 6.0 * (a * (2 * from + to) + b * (from + 2 * to));
    }
    return sum;
}

/// Subtracts the mean, or the straight line c0 + c1 t of least squares. The integrals of the rest, and of the
/// rest times t, over the length T are then zero, so the velocity ends as it began.
void correctBaseline(GroundMotion& motion, bool line) {
    const double start = motion.time.front(), length = motion.time.back() - start;
    const TimeMoments moments = momentsOf(motion);
    const Vec3 mean = moments.zeroth / length;
    Vec3 slope = Vec3::Zero();
    if (line) slope = 12.0 / (length * length * length) * (moments.first - 0.5 * length * moments.zeroth);
    for (std::size_t k = 0; k < motion.time.size(); ++k)
        motion.acceleration[k] -= mean + (motion.time[k] - start - 0.5 * length) * slope;
}

GroundMotion correctedMotion(const Record& record, double scale, Baseline baseline) {
    GroundMotion motion = motionOf(record, scale);
    if (baseline != Baseline::none) correctBaseline(motion, baseline == Baseline::line);
    return motion;
}

/// `file`, beside the scenario.
std::optional<Record> readFile(const std::string& folder, TableReader& table) {
    const auto file = table.text("file");
    if (!file) return std::nullopt;
    const std::string path = file->starts_with('/') ? *file : folder + *file;
    const auto text = toml::readFileText(path);
    if (!text) return table.error("file", path + ": " + text.errors().front().message), std::nullopt;
    std::string fault;
    auto record = RecordReader(*text).read(fault);
    if (!record) table.error("file", path + ", " + fault);
    return record;
}

/// `acceleration = [[time, x, y, z], ...]` in the scenario itself.
std::optional<Record> readInline(Report& report, TableReader& table) {
    const auto rows = table.array("acceleration");
    if (!rows) return std::nullopt;
    Record record;
    for (std::size_t k = 0; k < rows->size(); ++k) {
        const std::string field = table.fieldOf("acceleration") + "[" + std::to_string(k) + "]";
        const auto row = readNumbers(report, rows->at(k), field, kAnyNumber, 4);
        if (!row) return std::nullopt;
        const double least = record.time.empty() ? 0 : record.time.back(), time = row->front();
        if (time < least || (time == least && !record.time.empty())) {
            report.add(
                rows->at(k).place(), field,
                "found the time " + numberText(time) + " s" +
                    (record.time.empty() ? ", allowed: at least 0"
                                         : " after " + numberText(least) + " s, allowed: increasing times"));
            return std::nullopt;
        }
        record.time.push_back(time);
        record.value.emplace_back((*row)[1], (*row)[2], (*row)[3]);
    }
    if (record.time.size() >= 2) return record;
    return table.error("acceleration", "found fewer than two rows, allowed: at least two"), std::nullopt;
}

}  // namespace

std::optional<GroundMotion> parseGroundMotion(std::string_view text, double scale, Baseline baseline,
                                              std::string& fault) {
    const auto record = RecordReader(text).read(fault);
    if (!record) return std::nullopt;
    return correctedMotion(*record, scale, baseline);
}

void readGroundMotion(const ForceReader& from, Model& model) {
    auto table = from.root.table("ground_motion", {"file", "acceleration", "scale", "baseline"});
    if (!table || !table->requireOneOf({"file", "acceleration"})) return;
    const double scale = table->number("scale", kAnyNumber).value_or(1);
    const auto baseline = table->choice("baseline", {"none", "mean", "line"});
    const auto record = table->has("file") ? readFile(from.folder, *table) : readInline(from.report, *table);
    if (!record) return;
    model.ground_motion = correctedMotion(*record, scale, static_cast<Baseline>(baseline.value_or(0)));
    const auto run = from.root.find("run");
    if (!run || run->kind() != Kind::table || !run->find("duration_s"))
        model.run.duration = model.ground_motion.time.back();
}

}  // namespace talus::formats::scenario
