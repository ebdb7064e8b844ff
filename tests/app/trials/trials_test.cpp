// Records of passes and their comparison.
#include <doctest/doctest.h>

#include <cstdio>
#include <filesystem>

#include "app/trials/divergence.h"
#include "tests/temporary_folder.h"

using namespace weft;
using namespace weft::app;

namespace {

runtime::StepRecord step(const char* pass, const char* resource, std::uint64_t hash) {
  return {.pass = pass, .resource = resource, .hash = hash};
}

PassRecords threePasses() {
  return {
      "driver a", {{0, {step("sky", "hdr", 1), step("blur[2,1]", "glow", 2), step("tone", "ldr", 3)}}}, {}};
}

}  // namespace

TEST_CASE("a record is the same after it was written and read") {
  PassRecords records = threePasses();
  records.frames.push_back({7, {step("sort", "keys", ~0ull)}});
  const TemporaryFolder folder;
  text::Diagnostics diagnostics;
  const auto read = readRecords(folder.write("record", toText(records)), diagnostics);
  REQUIRE_MESSAGE(read.has_value(), diagnostics.text());
  CHECK(toText(*read) == toText(records));
  CHECK(read->frames[1].frame == 7);
  CHECK_FALSE(findDivergence(*read, records).has_value());
}

TEST_CASE("a damaged record is refused at its line") {
  const std::string good = toText(threePasses());
  for (const auto& [from, to, line] :
       {std::tuple("weft passes 2", "weft passes 1", 1u), std::tuple("frame 0", "frame x", 3u),
        std::tuple("0000000000000002\t", "000000000000000g\t", 5u), std::tuple("\tglow\n", "\n", 5u)}) {
    std::string text = good;
    text.replace(text.find(from), std::string(from).size(), to);
    const TemporaryFolder folder;
    text::Diagnostics diagnostics;
    CHECK_FALSE(readRecords(folder.write("record", text), diagnostics).has_value());
    REQUIRE(diagnostics.size() == 1);
    CHECK(diagnostics.items()[0].place.line == line);
  }
}

TEST_CASE("the first pass that differs, on one driver") {
  const PassRecords before = threePasses();
  PassRecords after = threePasses();
  after.frames[0].steps[1].hash = 20;
  after.frames[0].steps[2].hash = 30;
  const auto found = findDivergence(before, after);
  REQUIRE(found.has_value());
  CHECK(found->pass == "blur[2,1]");
  after.driver = "driver b";
  CHECK_FALSE(findDivergence(before, after).has_value());
}

TEST_CASE("passes that came and went are told where they stand") {
  const PassRecords before = threePasses();
  PassRecords after = threePasses();
  after.frames[0].steps.erase(after.frames[0].steps.begin() + 1);
  after.frames[0].steps[1].hash = 99;
  auto found = findDivergence(before, after);
  REQUIRE(found.has_value());
  CHECK(found->kind == Divergence::Kind::missing);
  CHECK(found->pass == "blur[2,1]");
  found = findDivergence(after, before);
  REQUIRE(found.has_value());
  CHECK(found->kind == Divergence::Kind::added);
  CHECK(found->pass == "blur[2,1]");
  after.frames[0].steps.pop_back();
  found = findDivergence(before, after);
  REQUIRE(found.has_value());
  CHECK(found->kind == Divergence::Kind::missing);
}

TEST_CASE("a culled pass is named only when nothing else differs") {
  const PassRecords before = threePasses();
  PassRecords after = threePasses();
  after.frames[0].steps.erase(after.frames[0].steps.begin());
  after.culled = {"sky"};
  auto found = findDivergence(before, after);
  REQUIRE(found.has_value());
  CHECK(found->pass == "sky");
  after.frames[0].steps[1].hash = 99;
  found = findDivergence(before, after);
  REQUIRE(found.has_value());
  CHECK(found->pass == "tone");
}
