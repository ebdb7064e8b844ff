#include <doctest/doctest.h>

#include "engine/text/json/report.h"
#include "engine/text/limits.h"

using namespace weft::text;

namespace {

Place at(std::uint32_t line) {
  static const FileName file = "a.json";
  return {file, line, 1};
}

}  // namespace

TEST_CASE("up to the limit everything is reported, in order") {
  Diagnostics all;
  for (std::uint32_t i = 100; i > 0; --i)
    all.add({.severity = Severity::warning,
             .code = Code::culledOverwritten,
             .message = "warning",
             .place = at(i)});
  const Diagnostics chosen = chooseMessages(all);
  CHECK(chosen.size() == 100);
  CHECK(chosen.items().front().place.line == 1);
  CHECK_FALSE(chosen.contains(Code::messagesLeftOut));
}

TEST_CASE("beyond it errors stay before warnings, from the first place on, and the rest is counted") {
  Diagnostics all;
  for (std::uint32_t i = 1; i <= 500; ++i) {
    all.add({.severity = Severity::warning,
             .code = Code::culledOverwritten,
             .message = "warning",
             .place = at(2 * i)});
    all.add({.code = Code::unknownKey, .message = "error", .place = at(2 * i + 1)});
    if (i <= 7)
      all.add(
          {.severity = Severity::note, .code = Code::unknownResource, .message = "note", .place = at(2 * i)});
  }
  const Diagnostics chosen = chooseMessages(all);
  REQUIRE(chosen.size() == 101);
  CHECK(chosen.errorCount() == 100);
  CHECK(chosen.items()[0].place.line == 3);
  CHECK(chosen.items()[99].place.line == 201);
  const Diagnostic& last = chosen.items().back();
  CHECK(last.code == Code::messagesLeftOut);
  CHECK(last.severity == Severity::note);
  CHECK(last.message == "further messages are left out: 400 errors, 500 warnings, 7 notes");
  CHECK(last.hint == "correct these first, or raise the limits with --limit 2, if that is meant");
  CHECK(chooseMessages(all, false).items().back().message ==
        "further messages are left out: 400 errors, 500 warnings, 0 notes");

  limitsRaised = 10;
  const Diagnostics most = chooseMessages(all);
  limitsRaised = 1;
  CHECK(most.size() == 1001);
  CHECK(most.items().back().message == "further messages are left out: 0 errors, 0 warnings, 7 notes");
  CHECK(most.items()[0].severity == Severity::warning);  // in the order of places again
}

TEST_CASE("a thousand errors end the search, and the note says so") {
  Diagnostics all;
  for (std::uint32_t i = 1; i <= 1000; ++i)
    all.add({.code = Code::unknownKey, .message = "error", .place = at(i)});
  CHECK(chooseMessages(all).items().back().message ==
        "further messages are left out: 900 errors, 0 warnings, 0 notes; no more were looked for");
}
