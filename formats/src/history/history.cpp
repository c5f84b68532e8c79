#include "talus/formats/history.h"

#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <fstream>
#include <utility>

#include "talus/formats/csv.h"

namespace talus::formats {

namespace {

constexpr std::string_view kFirstLine = "# talus history\n";
constexpr std::string_view kLastLine = "# end: ";
constexpr double kDegree = 0.017453292519943295;  // [rad]

/// Shortest text that reads back to the same bits.
void appendNumber(std::string& line, double value) {
    std::array<char, 32> text;
    line.append(text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr);
}

void appendNumbers(std::string& line, const Vec3& values) {
    for (const double value : {values.x(), values.y(), values.z()}) {
        line += ',';
        appendNumber(line, value);
    }
}

bool isRegular(const std::string& path) {
    struct stat info {};
    return ::stat(path.c_str(), &info) == 0 && S_ISREG(info.st_mode);
}

bool isRegular(int file) {
    struct stat info {};
    return ::fstat(file, &info) == 0 && S_ISREG(info.st_mode);
}

}  // namespace

HistoryFile inspectHistory(const std::string& path) {
    if (!isRegular(path)) return HistoryFile::absent;
    std::ifstream file(path, std::ios::binary);
    std::string line, last;
    if (!std::getline(file, line)) return file.eof() ? HistoryFile::empty : HistoryFile::foreign;
    if (line + '\n' != kFirstLine) return HistoryFile::foreign;
    while (std::getline(file, line)) last = std::move(line);
    return last.starts_with(kLastLine) ? HistoryFile::finished : HistoryFile::unfinished;
}

HistoryWriter::HistoryWriter(OutputFile file, std::string comments, std::vector<std::string> watch)
    : file_(std::move(file)), comments_(std::move(comments)), watch_(std::move(watch)) {}

Result<HistoryWriter> HistoryWriter::open(const std::string& path, std::string comments,
                                          std::vector<std::string> watch) {
    auto file = OutputFile::open(path);
    if (!file) return file.errors();
    return HistoryWriter(std::move(*file), std::move(comments), std::move(watch));
}

std::vector<Error> HistoryWriter::write(const HistoryRecord& record) {
    if (failed_) return {};
    if (std::exchange(started_, true)) return append(row(record));
    if (isRegular(file_.file()) && ::ftruncate(file_.file(), 0) != 0) return refusal(writeRefusal(errno));
    appendFromNowOn(file_.file());
    return append(head(record) + row(record));
}

std::vector<Error> HistoryWriter::finish(std::string_view how) {
    if (failed_ || !started_) return {};
    std::vector<Error> errors = append(std::string(kLastLine) + std::string(how) + "\n");
    if (const int error = errors.empty() ? file_.sync(written_) : 0; error != 0)
        errors = refusal(writeRefusal(error));
    return errors;
}

std::string HistoryWriter::head(const HistoryRecord& first) const {
    std::string text = std::string(kFirstLine) + comments_;
    text +=
        "# out_of_balance: largest out-of-balance force of a block over its weight; gravity energy is "
        "relative to "
        "the start; positions are of centroids, rotations are turned since the start\n";
    text += "time_s,step,kinetic_energy_j,elastic_energy_j,gravity_energy_j,out_of_balance";
    for (const std::string& block : watch_)
        for (const char* quantity : {"x_m", "y_m", "z_m", "vx_m_s", "vy_m_s", "vz_m_s", "rotation_deg"})
            text += ',' + csvField(block + "." + quantity);
    for (const WaterReport& water : first.waters)
        for (const char* quantity : {"level_m", "volume_m3", "run_over_m3"})
            text += ',' + csvField(water.name + "." + quantity);
    if (first.ground_acceleration) text += ",ground_ax_m_s2,ground_ay_m_s2,ground_az_m_s2";
    for (const Supports& kind : first.supports)
        for (const SupportReport& support : kind.reports) text += ',' + csvField(support.name + ".force_n");
    return text + '\n';
}

std::string HistoryWriter::row(const HistoryRecord& record) const {
    std::string line;
    appendNumber(line, record.time);
    line += ',' + std::to_string(record.step);
    for (const double value :
         {record.kinetic_energy, record.elastic_energy, record.gravity_energy, record.out_of_balance}) {
        line += ',';
        appendNumber(line, value);
    }
    for (const BlockReport& block : record.watch) {
        appendNumbers(line, block.position);
        appendNumbers(line, block.velocity);
        line += ',';
        appendNumber(line, block.rotation / kDegree);
    }
    for (const WaterReport& water : record.waters)
        for (const double value : {water.level, water.volume, water.run_over}) {
            line += ',';
            appendNumber(line, value);
        }
    if (record.ground_acceleration) appendNumbers(line, *record.ground_acceleration);
    for (const Supports& kind : record.supports)
        for (const SupportReport& support : kind.reports) {
            line += ',';
            appendNumber(line, support.force);
        }
    return line + '\n';
}

std::vector<Error> HistoryWriter::append(std::string_view text) {
    if (!isAsLong(file_.file(), written_)) return refusal(writeRefusal(ENOENT));
    while (!text.empty()) {
        const ssize_t written = ::write(file_.file(), text.data(), text.size());
        if (written >= 0) {
            text.remove_prefix(static_cast<std::size_t>(written));
            written_ += static_cast<std::uint64_t>(written);
        } else if (errno != EINTR) {
            return refusal(writeRefusal(errno));
        }
    }
    return {};
}

std::vector<Error> HistoryWriter::refusal(std::string why) {
    failed_ = true;
    return {Error{file_.path(), std::move(why)}};
}

}  // namespace talus::formats
