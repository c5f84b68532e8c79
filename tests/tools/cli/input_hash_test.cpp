// The hash of inputs is the one that xxh128sum prints.

#include "cli/input_hash.h"

#include <doctest/doctest.h>

#include <string>

using namespace talus::tools;

TEST_CASE("input hash: that of nothing is known, and every byte counts") {
    CHECK(xxh128("") == "99aa06d3014798d86001c324468d497f");
    const std::string text(1000, 'x');
    for (const std::size_t k : {0U, 500U, 999U}) {
        std::string other = text;
        other[k] = 'y';
        CHECK(xxh128(other) != xxh128(text));
    }
    CHECK(xxh128(text).size() == 32);
}
