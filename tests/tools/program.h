#pragma once
// Runs the talus program as a user does, and keeps what it said.

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "support/files.h"
#include "support/slower.h"

extern char** environ;

namespace talus::tools::testing {

using test::contentOf;
using test::kSlower;
using test::TemporaryFolder;

struct Outcome {
    int exit_code = -1;  ///< 128 + signal when a signal ended it, as in a shell
    std::string out, err;
    nlohmann::json json() const { return nlohmann::json::parse(out); }
};

/// How large files may become [KiB].
struct Room {
    std::size_t kib = 0;
};

/// A program that has been started; `outcome` waits for its end. stdout goes to `stdout_path` when given.
class Program {
 public:
    explicit Program(std::vector<std::string> arguments, const std::string& stdout_path = "") {
        arguments.insert(arguments.begin(), TALUS_PROGRAM);
        start(arguments, stdout_path);
    }

    /// The same with so much room for each of its files: as on a full disk, the system refuses what is more.
    /// Which lines ran is not counted: that file would be cut off, too.
    Program(Room room, std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"/bin/bash", "-c",
                                             "export LLVM_PROFILE_FILE=/dev/null; ulimit -f " +
                                                 std::to_string(room.kib) + "; exec \"$0\" \"$@\"",
                                             TALUS_PROGRAM});
        start(arguments, "");
    }

    void signal(int number) const {
        if (process_ > 0) kill(process_, number);
    }

    /// Whether it ends within this time; it can still be waited for.
    bool endsWithin(double seconds) const {
        const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
        for (;;) {
            siginfo_t info{};
            if (process_ < 0 ||
                waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
                info.si_pid != 0)
                return true;
            if (std::chrono::steady_clock::now() >= end) return false;
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
    }

    /// Computed so far [s]: what has begun, on a busy machine, too.
    double cpuSeconds() const {
        clockid_t clock{};
        timespec time{};
        if (process_ < 0 || clock_getcpuclockid(process_, &clock) != 0 || clock_gettime(clock, &time) != 0)
            return 0;
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    }

    /// Whether it has computed for so long [s of CPU time] and catches Ctrl-C: built with sanitizers, on a
    /// busy machine, it may still be reading its command line after a tenth of a second, and a signal simply
    /// ends it.
    bool hasBegun(double seconds) const { return cpuSeconds() > seconds && catches(SIGINT); }

    Outcome outcome() {
        int status = 0;
        if (process_ < 0 || waitpid(process_, &status, 0) != process_) return {};
        const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        return {code, contentOf(folder_ / "out"), contentOf(folder_ / "err")};
    }

 private:
    /// proc(5): the mask of the signals that a process catches.
    bool catches(int number) const {
        constexpr std::string_view key = "SigCgt:";
        const std::string status = contentOf("/proc/" + std::to_string(process_) + "/status");
        const std::size_t at = status.find(key);
        return at != std::string::npos &&
               (std::strtoull(status.c_str() + at + key.size(), nullptr, 16) >> (number - 1) & 1) != 0;
    }

    void start(std::vector<std::string>& arguments, const std::string& stdout_path) {
        std::vector<char*> argv;
        for (std::string& argument : arguments) argv.push_back(argument.data());
        argv.push_back(nullptr);
        const std::string out = stdout_path.empty() ? folder_ / "out" : stdout_path;
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT, 0600);
        posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, (folder_ / "err").c_str(),
                                         O_WRONLY | O_CREAT, 0600);
        if (posix_spawn(&process_, argv.front(), &actions, nullptr, argv.data(), environ) != 0) process_ = -1;
        posix_spawn_file_actions_destroy(&actions);
    }

    TemporaryFolder folder_;
    pid_t process_ = -1;
};

inline Outcome runTalus(std::vector<std::string> arguments, const std::string& stdout_path = "") {
    return Program(std::move(arguments), stdout_path).outcome();
}

/// True as soon as `condition` holds; false after `seconds`.
template <class Condition>
bool waitFor(Condition condition, double seconds = 60) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (std::chrono::steady_clock::now() < end) {
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
}

/// A block of b x h on a plane: it slides at its friction angle or overturns at atan(b/h).
inline std::string blockScenario(double tilt_deg, double friction_deg, const std::string& more = "") {
    std::ostringstream text;
    text << "[gravity]\ntilt_deg = " << tilt_deg
         << "\n[joint.default]\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\n"
         << "friction_deg = " << friction_deg << "\n[material.rock]\ndensity = 2600.0\n"
         << "[[block]]\nname = \"floor\"\nbox = { min = [-5.0, -1.0, -0.5], max = [5.0, 2.0, 0.0] }\nfixed = "
            "true\n"
         << "[[block]]\nname = \"key\"\nbox = { min = [0.0, 0.0, 0.0], max = [1.0, 1.0, 0.5] }\n"
         << more;
    return text.str();
}

}  // namespace talus::tools::testing
