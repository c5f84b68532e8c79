#pragma once
// Runs the talus program as a user does, and keeps what it said.

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

extern char** environ;

namespace talus::tools::testing {

inline std::string contentOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

/// A folder of its own, gone with the test.
class TemporaryFolder {
 public:
    TemporaryFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "talus-test-XXXXXX").string();
        path_ = mkdtemp(name.data());
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::string operator/(const std::string& name) const { return (path_ / name).string(); }
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(path_ / name, std::ios::binary) << text;
        return *this / name;
    }
    std::size_t files() const {
        return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_), {}));
    }

 private:
    std::filesystem::path path_;
};

struct Outcome {
    int exit_code = -1;  ///< 128 + signal when a signal ended it, as in a shell
    std::string out, err;
    nlohmann::json json() const { return nlohmann::json::parse(out); }
};

/// A program that has been started; `outcome` waits for its end. stdout goes to `stdout_path` when given.
class Program {
 public:
    explicit Program(std::vector<std::string> arguments, const std::string& stdout_path = "") {
        arguments.insert(arguments.begin(), TALUS_PROGRAM);
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
        if (posix_spawn(&process_, TALUS_PROGRAM, &actions, nullptr, argv.data(), environ) != 0)
            process_ = -1;
        posix_spawn_file_actions_destroy(&actions);
    }

    void signal(int number) const {
        if (process_ > 0) kill(process_, number);
    }

    Outcome outcome() {
        int status = 0;
        if (process_ < 0 || waitpid(process_, &status, 0) != process_) return {};
        const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        return {code, contentOf(folder_ / "out"), contentOf(folder_ / "err")};
    }

 private:
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
