#pragma once
// Properties that hold for whatever is drawn (rapidcheck), as doctest checks: the same draws in every run,
// and the smallest counterexample in the message.

#include <doctest/doctest.h>
#include <rapidcheck.h>
#include <rapidcheck/detail/TestListenerAdapter.h>

#include <Eigen/Core>
#include <sstream>
#include <string>
#include <unordered_map>
#include <utility>

namespace talus::test {

/// Checks that a function of drawn arguments returns (or RC_ASSERTs) true, `times` times.
template <class Property>
void checkProperty(const std::string& name, int times, Property&& property) {
    rc::detail::TestParams params;
    params.seed = 20260101;
    params.maxSuccess = times;
    rc::detail::TestMetadata metadata;
    metadata.id = metadata.description = name;
    rc::detail::TestListenerAdapter quiet;
    const std::unordered_map<std::string, rc::detail::Reproduce>
        nothing;  // and no settings from the environment
    const auto result =
        rc::detail::checkTestable(std::forward<Property>(property), metadata, params, quiet, nothing);
    std::ostringstream text;
    rc::detail::printResultMessage(result, text);
    CAPTURE(text.str());
    CHECK(result.template is<rc::detail::SuccessResult>());
}

/// A number in [low, high] out of a few thousand, so that a counterexample shrinks to plain ones.
inline rc::Gen<double> numberIn(double low, double high) {
    constexpr int kSteps = 4096;
    return rc::gen::map(rc::gen::inRange(0, kSteps + 1),
                        [=](int step) { return low + (high - low) * step / kSteps; });
}

}  // namespace talus::test
