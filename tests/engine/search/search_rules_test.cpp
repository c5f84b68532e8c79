#include "talus/search_rules.h"

#include <doctest/doctest.h>

#include <set>
#include <string>

using namespace talus;

TEST_CASE("every rule of the searches is listed once, and described") {
    SearchRules rules;
    std::set<std::string> names;
    std::set<const double*> members;
    for (const SearchRule& rule : searchRules()) {
        CAPTURE(rule.name);
        names.insert(rule.name);
        members.insert(&(rules.*rule.value));
        CHECK(rules.*rule.value > 0);
        CHECK(!std::string(rule.meaning).empty());
        CHECK(!std::string(rule.effect).empty());
    }
    CHECK(names.size() == searchRules().size());
    CHECK(members.size() * sizeof(double) == sizeof(SearchRules));
}
