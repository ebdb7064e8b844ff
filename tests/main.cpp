// Every test executable: doctest, and exit code 77, which ctest shows as Skipped, when all cases that ran
// skipped (tests/skip.h).
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>

#include "tests/skip.h"

namespace weft::test {
namespace {

constexpr int kSkipped = 77;

int skipped = 0, ran = 0, forbidden = 0;
bool skips = false, failed = false;

// Counts; what the console prints is doctest's own.
struct SkipCounter : doctest::IReporter {
  explicit SkipCounter(const doctest::ContextOptions&) {}
  void test_case_start(const doctest::TestCaseData&) override { skips = false; }
  void test_case_end(const doctest::CurrentTestCaseStats& stats) override {
    failed |= stats.failure_flags != doctest::TestCaseFailureReason::None;
    ++(skips ? skipped : ran);
  }
  void test_case_skipped(const doctest::TestCaseData& data) override {
    if (!data.m_skip) return;  // left out by a filter; one with doctest::skip is never welcome
    std::printf("FAILED: '%s' has doctest::skip, which nobody sees; use weft::test::skipCase\n", data.m_name);
    ++forbidden;
  }
  void report_query(const doctest::QueryData&) override {}
  void test_run_start() override {}
  void test_run_end(const doctest::TestRunStats&) override {}
  void test_case_reenter(const doctest::TestCaseData&) override {}
  void test_case_exception(const doctest::TestCaseException&) override {}
  void subcase_start(const doctest::SubcaseSignature&) override {}
  void subcase_end() override {}
  void log_assert(const doctest::AssertData& assertion) override {
    failed |= assertion.m_failed && !(assertion.m_at & doctest::assertType::is_warn);
  }
  void log_message(const doctest::MessageData&) override {}
};
REGISTER_LISTENER("skips", 1, SkipCounter);

void say(const std::string& why) {
  std::printf("skipped: %s\n", why.c_str());
  std::fflush(stdout);
}

}  // namespace

void skipCase(const std::string& why) {
  skips = true;
  say(why);
}

void skipAll(const std::string& why) {
  say(why);
  std::exit(failed ? EXIT_FAILURE : kSkipped);
}

}  // namespace weft::test

int main(int argc, char** argv) {
  using namespace weft::test;
  doctest::Context context(argc, argv);
  const int result = context.run();
  if (context.shouldExit() || result != 0) return result;
  if (forbidden != 0) return EXIT_FAILURE;
  if (skipped != 0 && ran != 0) {
    std::printf("FAILED: %d of %d cases skipped; they need a ctest of their own: weft_test(… APART suite)\n",
                skipped, skipped + ran);
    return EXIT_FAILURE;
  }
  return skipped != 0 ? kSkipped : EXIT_SUCCESS;
}
