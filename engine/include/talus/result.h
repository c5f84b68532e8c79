#pragma once
// Errors are values: the library never prints, exits or throws on bad input.

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace talus {

/// One fault of the input. `field` is the path a user wrote or should have written ("stack[0].columns"). The
/// scenario reader fills in file, line and column, which are 0 and "" until then.
struct Error {
    std::string field;
    std::string message;  ///< what was found and what is allowed
    std::string file{};
    int line = 0;    ///< 1-based, 0 when unknown
    int column = 0;  ///< 1-based, 0 when unknown
};

/// Either a value or at least one error, never both.
template <class T>
class Result {
 public:
    Result(T value) : value_(std::move(value)) {}
    Result(Error error) { errors_.push_back(std::move(error)); }
    Result(std::vector<Error> errors) : errors_(std::move(errors)) {}

    bool ok() const { return value_.has_value(); }
    explicit operator bool() const { return ok(); }
    T& operator*() & { return *value_; }
    const T& operator*() const& { return *value_; }
    /// The value of a temporary result (`*buildState(model, true)`): moved out, since a copy may be
    /// gigabytes.
    T operator*() && { return std::move(*value_); }
    T* operator->() { return &*value_; }
    const T* operator->() const { return &*value_; }
    const std::vector<Error>& errors() const { return errors_; }

 private:
    std::optional<T> value_;
    std::vector<Error> errors_;
};

}  // namespace talus
