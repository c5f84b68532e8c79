#pragma once
// How a command ends, and its failures: throw these, main prints them (on stderr, and as JSON on stdout with
// --json) and exits. The library underneath never throws, prints or exits.

#include <exception>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "talus/result.h"

namespace talus::tools {

enum ExitCode : int {
    kDone = 0,
    kInternalError = 1,
    kOutsideBand = 1,  ///< of `talus verification`: a row differs from its stated result
    kBadInput = 2,     ///< bad input, missing file or wrong usage
    kUndecided = 3,    ///< the analysis ended undecided, or runs of a batch failed
    kFileRefused = 4,  ///< the file system refused
    kInterrupted = 130
};

/// Faults of the user's input; exit code 2.
struct BadInput : std::exception {
    explicit BadInput(std::vector<Error> list) : errors(std::move(list)) {}
    explicit BadInput(Error error) { errors.push_back(std::move(error)); }
    const char* what() const noexcept override { return "bad input"; }
    std::vector<Error> errors;
};

/// The file system refused (no space, no permission, no such folder); exit code 4. what() names path and
/// reason.
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

}  // namespace talus::tools
