// The talus command line: finds the subcommand, runs it, and turns every failure into a message and an exit
// code.

#include <fcntl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numeric>
#include <sstream>

#include "cli/failures.h"
#include "cli/help.h"
#include "cli/json.h"
#include "cli/provenance.h"
#include "cli/signals.h"
#include "cli/terminal.h"
#include "cli/text.h"
#include "commands/commands.h"
#include "talus/build_info.h"
#include "talus/formats/scenario.h"

namespace talus::tools {

namespace {

std::string versionText() {
    const BuildInfo& build = buildInfo();
    return "talus " + build.version + " (" + build.git_hash + ", " + build.compiler + ", " +
           build.instruction_set + ", " + build.build_type + ")";
}

bool wantsJson(int argc, char** argv) {
    return std::any_of(argv + 1, argv + argc,
                       [](const char* word) { return std::strcmp(word, "--json") == 0; });
}

/// Prints faults as text on stderr and, with --json, as an object on stdout.
int report(const std::vector<Error>& errors, bool json, int exit_code) {
    for (const Error& error : errors) std::fprintf(stderr, "%s\n", formats::format(error).c_str());
    if (json) printJson(errorsJson(errors));
    return exit_code;
}

/// The same for faults that have no place in a file.
int report(const std::string& prefix, const std::string& message, bool json, int exit_code) {
    std::fprintf(stderr, "%s: %s\n", prefix.c_str(), message.c_str());
    if (json) printJson(errorsJson({Error{"", message}}));
    return exit_code;
}

/// Levenshtein distance: letters to insert, delete or replace.
std::size_t distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), 0);
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, replaced}));
        }
    }
    return row[b.size()];
}

std::string unknownCommand(const std::string& word, const std::vector<Command>& commands) {
    const auto nearest =
        std::min_element(commands.begin(), commands.end(), [&](const Command& a, const Command& b) {
            return distance(word, a.app->get_name()) < distance(word, b.app->get_name());
        });
    const std::string name = nearest->app->get_name();
    const bool close = distance(word, name) <= 1 + name.size() / 3 || name.starts_with(word);
    return "there is no command '" + word + "'" + (close ? "; did you mean '" + name + "'?" : "") +
           " ('talus --help' lists them)";
}

std::vector<Command> addCommands(CLI::App& root) {
    std::vector<Command> commands{addPaper(root)};
    for (const LoadSearch& search : loadSearches()) commands.push_back(addSearch(root, search));
    for (const auto add : {addRun, addReplay, addInspect, addExport, addBatch, addSample, addMerge,
                           addValidate, addBlocks, addTheory, addKinematics, addFlow, addLimitAnalysis,
                           addKeyBlocks, addReport, addStorm, addSupport, addVerification, addSchema})
        commands.push_back(add(root));
    return commands;
}

int execute(const std::vector<Command>& commands) {
    for (const Command& command : commands)
        if (command.app->parsed()) return command.execute();
    return kInternalError;  // CLI11 requires a subcommand, so one of them was parsed
}

/// Help, version and wrong usage.
int onParseError(const CLI::App& root, const CLI::ParseError& error, bool json) {
    if (error.get_exit_code() == 0) {
        std::ostringstream asked_for;
        const int done = root.exit(error, asked_for, asked_for);
        printText(asked_for.str());
        return done;
    }
    std::string command = "talus";
    for (const CLI::App* app = &root; !app->get_subcommands().empty();) {
        app = app->get_subcommands().front();
        command += " " + app->get_name();
    }
    return report("error", error.what() + std::string(" ('") + command + " --help' shows the usage)", json,
                  kBadInput);
}

/// "talus help COMMAND" as "talus COMMAND --help".
std::vector<std::string> withHelpAsOption(int argc, char** argv) {
    std::vector<std::string> words(argv + 1, argv + argc);
    if (words.empty() || words.front() != "help") return words;
    words.erase(words.begin());
    words.push_back("--help");
    return words;
}

int runTool(int argc, char** argv, bool json) {
    CLI::App root("Talus: rigid-block discrete elements for jointed rock slopes with water in their fissures",
                  "talus");
    root.formatter(std::make_shared<HelpFormatter>(columnsOf(STDOUT_FILENO, 100)));
    root.set_version_flag("-V,--version", versionText(), "Version, git hash and compiler");
    root.require_subcommand(1);
    root.footer(
        "Example:\n  talus critical-angle bench/paper/fissure-1.toml\n\n'talus help COMMAND' explains a "
        "command. Exit codes: 0 done, 1 internal error, 2 bad input or usage, 3 undecided or runs of a batch "
        "failed, 4 file system error, 130 interrupted.");
    const std::vector<Command> commands = addCommands(root);
    std::vector<std::string> words = withHelpAsOption(argc, argv);
    const bool names_unknown = !words.empty() && words[0][0] != '-' &&
                               std::none_of(commands.begin(), commands.end(), [&](const Command& command) {
                                   return command.app->get_name() == words[0];
                               });
    if (names_unknown) return report("error", unknownCommand(words[0], commands), json, kBadInput);
    std::reverse(words.begin(), words.end());  // as CLI11 wants them
    try {
        root.parse(words);
    } catch (const CLI::ParseError& error) {
        return onParseError(root, error, json);
    }
    catchStopSignals();
    return execute(commands);
}

/// Settings of the environment hold, or are refused.
void checkInstructionSet() {
    const char* wanted = std::getenv(kInstructionSetVariable);
    if (wanted == nullptr || buildInfo().instruction_set == wanted) return;
    throw BadInput(
        {Error{kInstructionSetVariable,
               "found \"" + std::string(wanted) +
                   "\", allowed: \"x86-64\", and \"avx2\" or \"avx512\" if this processor has it"}});
}

/// Opens /dev/null in place of standard streams that the caller closed. Otherwise the next file to be opened
/// would get their descriptor, and messages would be written into it. \return whether all three are open
bool openStandardStreams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(stream, F_GETFD) < 0 && ::open("/dev/null", O_RDWR) != stream) return false;
    return true;
}

int guarded(int argc, char** argv) {
    const bool json = wantsJson(argc, argv);
    try {
        checkInstructionSet();
        return runTool(argc, argv, json);
    } catch (const BadInput& bad) {
        return report(bad.errors, json, kBadInput);
    } catch (const FileRefused& refused) {
        return report("error", refused.what(), json, kFileRefused);
    } catch (const std::exception& error) {
        return report("internal error", error.what(), json, kInternalError);
    }
}

}  // namespace

}  // namespace talus::tools

int main(int argc, char** argv) {
    if (!talus::tools::openStandardStreams()) return talus::tools::kFileRefused;
    talus::tools::ignoreFileSizeSignal();
    talus::tools::rememberCommandLine(argc, argv);
    try {
        return talus::tools::guarded(argc, argv);
    } catch (const std::exception& error) {  // stdout itself refused the report
        std::fprintf(stderr, "error: %s\n", error.what());
        return talus::tools::kFileRefused;
    }
}
