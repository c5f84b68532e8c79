#pragma once
// The talus program on a terminal of its own.

#include <sys/ioctl.h>

#include <cstdlib>
#include <regex>

#include "tools/program.h"

namespace talus::tools::testing {

/// What the program shows on a terminal with so many columns, all of it.
inline std::string shownOnTerminal(std::vector<std::string> arguments, unsigned short columns) {
    const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
    if (terminal < 0 || grantpt(terminal) != 0 || unlockpt(terminal) != 0) return "";
    const winsize size{40, columns, 0, 0};
    ioctl(terminal, TIOCSWINSZ, &size);
    const std::string name = ptsname(terminal);
    arguments.insert(arguments.begin(), {"/usr/bin/env", "-u", "COLUMNS", TALUS_PROGRAM});
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        posix_spawn_file_actions_addopen(&actions, stream, name.c_str(), O_RDWR | O_NOCTTY, 0);
    pid_t process = -1;
    std::string shown;
    if (posix_spawn(&process, argv.front(), &actions, nullptr, argv.data(), environ) == 0) {
        char piece[4096];
        // Ends with an error once the last program on it is gone.
        for (ssize_t count; (count = read(terminal, piece, sizeof piece)) > 0;)
            shown.append(piece, static_cast<std::size_t>(count));
        int status = 0;
        waitpid(process, &status, 0);
    }
    posix_spawn_file_actions_destroy(&actions);
    close(terminal);
    return shown;
}

/// Its lines as they stay: without what was wiped.
inline std::vector<std::string> plainLines(const std::string& shown) {
    std::istringstream all(
        std::regex_replace(shown, std::regex("\r\x1b\\[2K[^\r\n]*(?=\r\x1b)|\r(\x1b\\[2K)?"), ""));
    std::vector<std::string> lines;
    for (std::string line; std::getline(all, line);) lines.push_back(line);
    return lines;
}

}  // namespace talus::tools::testing
