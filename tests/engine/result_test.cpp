#include "talus/result.h"

#include <doctest/doctest.h>

#include <memory>
#include <type_traits>

namespace talus {
namespace {

Result<std::unique_ptr<int>> seven() { return std::make_unique<int>(7); }

TEST_CASE("a value is moved out of a temporary result") {
    const std::unique_ptr<int> value = *seven();  // cannot be copied
    CHECK(*value == 7);
}

TEST_CASE("a result that is kept keeps its value") {
    Result<std::unique_ptr<int>> kept = seven();
    **kept = 8;
    CHECK(**kept == 8);
    static_assert(std::is_same_v<decltype(*kept), std::unique_ptr<int>&>);
}

TEST_CASE("errors and no value") {
    const Result<int> failed = Error{"block[0]", "has no volume"};
    CHECK_FALSE(failed.ok());
    REQUIRE(failed.errors().size() == 1);
    CHECK(failed.errors()[0].field == "block[0]");
}

}  // namespace
}  // namespace talus
