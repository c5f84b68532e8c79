#include "talus/formats/history.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <utility>

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

/// A block's name followed by a quantity, quoted where CSV needs it.
std::string columnName(const std::string& block, const char* quantity) {
    const std::string name = block + "." + quantity;
    if (name.find_first_of(",\"\n") == std::string::npos) return name;
    std::string quoted = "\"";
    for (const char c : name) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + '"';
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

Result<HistoryWriter> HistoryWriter::open(const std::string& path, std::string comments,
                                          std::vector<std::string> watch) {
    constexpr int kMode = 0666;  // the user's umask decides
    int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kMode);
    const bool created = file >= 0;
    if (!created && errno == EEXIST) file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (file < 0) return Error{path, std::string("cannot be opened for writing: ") + std::strerror(errno)};
    return HistoryWriter(file, created, path, std::move(comments), std::move(watch));
}

HistoryWriter::HistoryWriter(int file, bool created, std::string path, std::string comments,
                             std::vector<std::string> watch)
    : file_(file),
      created_(created),
      path_(std::move(path)),
      comments_(std::move(comments)),
      watch_(std::move(watch)) {}

HistoryWriter::HistoryWriter(HistoryWriter&& other) noexcept
    : file_(std::exchange(other.file_, -1)),
      created_(other.created_),
      started_(other.started_),
      failed_(other.failed_),
      path_(std::move(other.path_)),
      comments_(std::move(other.comments_)),
      watch_(std::move(other.watch_)) {}

HistoryWriter::~HistoryWriter() {
    if (file_ < 0) return;
    ::close(file_);
    if (created_ && !started_) ::unlink(path_.c_str());
}

std::vector<Error> HistoryWriter::write(const HistoryRecord& record) {
    if (failed_) return {};
    if (std::exchange(started_, true)) return append(row(record));
    if (isRegular(file_) && ::ftruncate(file_, 0) != 0) return refusal("cannot be emptied", errno);
    return append(head() + row(record));
}

std::vector<Error> HistoryWriter::finish(std::string_view how) {
    if (failed_ || !started_) return {};
    std::vector<Error> errors = append(std::string(kLastLine) + std::string(how) + "\n");
    if (::close(std::exchange(file_, -1)) != 0 && errors.empty()) errors = refusal("cannot be closed", errno);
    return errors;
}

std::string HistoryWriter::head() const {
    std::string text = std::string(kFirstLine) + comments_;
    text +=
        "# out_of_balance: largest out-of-balance force of a block over its weight; gravity energy is "
        "relative to "
        "the start; positions are of centroids, rotations are turned since the start\n";
    text += "time_s,step,kinetic_energy_j,elastic_energy_j,gravity_energy_j,out_of_balance";
    for (const std::string& block : watch_)
        for (const char* quantity : {"x_m", "y_m", "z_m", "vx_m_s", "vy_m_s", "vz_m_s", "rotation_deg"})
            text += ',' + columnName(block, quantity);
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
    return line + '\n';
}

std::vector<Error> HistoryWriter::append(std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = ::write(file_, text.data(), text.size());
        if (written >= 0) {
            text.remove_prefix(static_cast<std::size_t>(written));
        } else if (errno != EINTR) {
            return refusal("cannot be written", errno);
        }
    }
    return {};
}

std::vector<Error> HistoryWriter::refusal(const char* doing, int error_number) {
    failed_ = true;
    return {Error{path_, std::string(doing) + ": " + std::strerror(error_number)}};
}

}  // namespace talus::formats
