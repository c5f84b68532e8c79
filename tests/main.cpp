// Runs the tests. `talus-tests --help` lists doctest's own options; `talus-tests -tc='*toppling*'` runs some.
//
// CTest runs one process per source file, so that files run side by side. A test that takes more than a few
// seconds goes into a suite whose name starts with "slow": TEST_SUITE("slow: physics"). Its part of the file
// gets a CTest entry and the label `slow`; tools/check leaves it out, .ci/run does not.

#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

namespace {

bool nothing_ran = false;

/// A filter that matches nothing must not pass for success.
struct EmptyRunListener : doctest::IReporter {
    explicit EmptyRunListener(const doctest::ContextOptions&) {}
    void report_query(const doctest::QueryData&) override {}
    void test_run_start() override {}
    void test_run_end(const doctest::TestRunStats& run) override {
        nothing_ran = run.numTestCasesPassingFilters == 0;
    }
    void test_case_start(const doctest::TestCaseData&) override {}
    void test_case_reenter(const doctest::TestCaseData&) override {}
    void test_case_end(const doctest::CurrentTestCaseStats&) override {}
    void test_case_exception(const doctest::TestCaseException&) override {}
    void subcase_start(const doctest::SubcaseSignature&) override {}
    void subcase_end() override {}
    void log_assert(const doctest::AssertData&) override {}
    void log_message(const doctest::MessageData&) override {}
    void test_case_skipped(const doctest::TestCaseData&) override {}
};

}  // namespace

REGISTER_LISTENER("empty-run", 1, EmptyRunListener);

int main(int argc, char** argv) {
    doctest::Context context(argc, argv);
    const int failed = context.run();
    return failed == 0 && nothing_ran ? 1 : failed;
}
