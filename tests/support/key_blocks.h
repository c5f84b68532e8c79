#pragma once
// Block theory of a model, for tests.

#include <doctest/doctest.h>

#include <utility>

#include "talus/block_theory.h"

namespace talus::test {

inline KeyBlockResult found(const Model& model, std::size_t most = 100) {
    auto result = keyBlocks(model, {}, {.most_groups = most});
    for (const Error& error : result.errors()) FAIL_CHECK(error.field << ": " << error.message);
    REQUIRE(result.ok());
    return std::move(*result);
}

}  // namespace talus::test
