#pragma once
// What the subcommands of the command line share. Each subcommand is one file that offers one `addX(root)`
// (commands/commands.h); it fills a CLI::App and returns the function that does the work. Failures are thrown (BadInput, FileRefused) and turned into
// messages and exit codes in one place, main.cpp. The library underneath never throws, prints or exits.

#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <functional>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "talus/analysis.h"
#include "talus/formats/scenario.h"
#include "talus/result.h"

namespace talus::tools {

using Json = nlohmann::ordered_json;  ///< keys stay in the order they were put in

enum ExitCode : int {
    kDone = 0,
    kInternalError = 1,
    kBadInput = 2,     ///< bad input, missing file or wrong usage
    kUndecided = 3,    ///< the analysis ended undecided, or runs of a batch failed
    kFileRefused = 4,  ///< the file system refused
    kInterrupted = 130
};

/// Options every computing subcommand takes.
struct Common {
    bool json = false;   ///< one JSON object on stdout
    bool quiet = false;  ///< no progress and no notes on stderr
    int threads = 0;     ///< 0: all cores
};

/// Adds --json, --quiet and (where it computes) --threads to a subcommand.
void addCommon(CLI::App& app, Common& common, bool computes = true);

/// A subcommand: its options, and what it does once they are parsed; `execute` returns an exit code.
struct Command {
    CLI::App* app = nullptr;
    std::function<int()> execute;
};

// --- failures: throw these, main prints them (on stderr, and as JSON on stdout with --json) and exits ---------------

/// Faults of the user's input; exit code 2.
struct BadInput : std::exception {
    explicit BadInput(std::vector<Error> list) : errors(std::move(list)) {}
    explicit BadInput(Error error) { errors.push_back(std::move(error)); }
    const char* what() const noexcept override { return "bad input"; }
    std::vector<Error> errors;
};

/// The file system said no (no space, no permission, no such folder); exit code 4. what() names path and reason.
struct FileRefused : std::runtime_error {
    FileRefused(const std::string& path, const std::string& doing, int error_number);
    explicit FileRefused(const std::string& message) : std::runtime_error(message) {}
};

/// The value of a result, or BadInput with its errors.
template <class T>
T valueOf(Result<T> result) {
    if (!result.ok()) throw BadInput(result.errors());
    return std::move(*result);
}

/// The same for results of the engine, whose errors know fields but not the places in the scenario file.
template <class T>
T valueOf(Result<T> result, const formats::Scenario& scenario) {
    if (!result.ok()) throw BadInput(formats::placed(scenario, result.errors()));
    return std::move(*result);
}

/// Reads a scenario file; throws BadInput. The second tells its warnings on stderr, too.
formats::Scenario loadScenario(const std::string& path);
formats::Scenario loadScenario(const std::string& path, const Common& common);

// --- interruption ---------------------------------------------------------------------------------------------------

/// Lets SIGINT and SIGTERM set the flag below instead of ending the process; a second one ends it at once.
void catchStopSignals();

/// True once the user asked to stop. Pass its address as Control::stop.
const std::atomic<bool>& stopRequested();

/// Ends a computation from within one of its callbacks (an output file can no longer be written).
void requestStop();

// --- progress and notes on stderr -----------------------------------------------------------------------------------

/// A bar when stderr is a terminal, plain lines now and then when it is not, nothing with --quiet.
class ProgressPrinter {
 public:
    explicit ProgressPrinter(const Common& common);
    ~ProgressPrinter() { finish(); }
    ProgressPrinter(const ProgressPrinter&) = delete;
    ProgressPrinter& operator=(const ProgressPrinter&) = delete;

    void show(const Progress& progress);
    void finish();  ///< wipes the bar; safe to call twice

    /// For Control::progress; the printer must outlive it.
    std::function<void(const Progress&)> callback();

 private:
    using Clock = std::chrono::steady_clock;
    void showBar(const Progress& progress, double elapsed);
    void showLine(const Progress& progress, double elapsed);

    bool quiet_ = false, terminal_ = false, bar_shown_ = false;
    std::string stage_;
    Clock::time_point start_, last_;
    double interval_ = 0;  ///< between two outputs [s]
};

/// Progress, stop flag and threads, as the engine takes them.
Control controlOf(const Common& common, ProgressPrinter& progress);

/// A line for people on stderr ("warning: ..."); nothing with --quiet.
void note(const Common& common, const std::string& line);

// --- results --------------------------------------------------------------------------------------------------------

void printJson(const Json& json);                ///< one object and a newline on stdout; throws FileRefused
void printText(const std::string& text);         ///< on stdout; throws FileRefused
Json number(double value);                       ///< null when not finite
Json vector(const Vec3& value);                  ///< [x, y, z]
std::string hashText(std::uint64_t state_hash);  ///< 16 hex digits
std::string text(double value, int decimals);    ///< fixed notation, locale-free
Json errorsJson(
    const std::vector<Error>& errors);  ///< {"ok": false, "errors": [{file, line, column, field, message}]}

constexpr double kDegree = 0.017453292519943295;  ///< [rad]
constexpr double degrees(double radians) { return radians / kDegree; }
constexpr double radians(double degrees) { return degrees * kDegree; }

// --- provenance: who computed this, from what -----------------------------------------------------------------------

void rememberCommandLine(int argc, const char* const* argv);
const std::string& commandLine();
int threadsUsed(const Common& common);

/// {version, git_hash, compiler, instruction_set, build_type, threads, scenario, command_line}; put it under the key
/// `provenance`. `scenario_path` may be empty (null then).
Json provenance(const Common& common, const std::string& scenario_path);

/// The same as comment lines "# key: value", for the head of CSV files.
std::string provenanceComments(const Common& common, const std::string& scenario_path);

// --- files ----------------------------------------------------------------------------------------------------------

/// Writes a whole file: into a temporary one beside it, then renamed, so that no half-written file is ever left. What
/// is not a regular file (a device, a pipe) is written in place. Throws FileRefused.
void writeFile(const std::string& path, std::string_view content);

/// Makes a folder and its parents if needed; throws FileRefused.
void makeFolder(const std::string& path);

}  // namespace talus::tools
