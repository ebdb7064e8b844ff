// One mistake is reported once: what is only missing because a pass was left out for its mistakes is no second one.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <map>

#include "tests/graph/expand/support.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;

namespace {

text::Diagnostics diagnoseText(const std::string& text) {
  text::Diagnostics diagnostics;
  const auto desc = readGraphText(text, "followers.json", diagnostics);
  REQUIRE_MESSAGE(desc, diagnostics.text());
  expandGraph(*desc, testRegistry(), {}, diagnostics);
  return diagnostics;
}

// A chain of passes: pass i reads what pass i-1 wrote. Every tenth has a mistake, of five kinds in turn.
std::string chainOf(int count) {
  std::string resources = R"("ldr": { "texture": "rgba8", "size": 8 })", passes;
  for (int i = 0; i < count; ++i) {
    const int mistake = i % 10 == 5 ? i / 10 % 5 : -1;
    resources += fmt::format(", \"r{}\": {{ \"texture\": \"{}\", \"size\": 8 }}", i,
                             mistake == 0 ? "rgba9x" : "rgba8");
    const std::string read = mistake == 1 ? fmt::format("\"read\": {{ \"source\": \"nowhere{}\" }}, ", i)
                             : i > 0      ? fmt::format("\"read\": {{ \"source\": \"r{}\" }}, ", i - 1)
                                          : "";
    const char* const extra = mistake == 2   ? ", \"enabled\": \"$absent\""
                              : mistake == 3 ? ", \"enabled\": \"soft\""
                              : mistake == 4 ? ", \"repeat\": { \"k\": [0, 0, 0] }"
                                             : "";
    passes += fmt::format(
        "{}{{ \"name\": \"p{}\", \"type\": \"fullscreen\", \"shader\": \"a.frag.glsl\", {}\"write\": {{ "
        "\"result\": \"r{}\" }}{} }}",
        i ? ",\n" : "", i, read, i, extra);
  }
  passes += fmt::format(
      ",\n{{ \"name\": \"show\", \"type\": \"fullscreen\", \"shader\": \"a.frag.glsl\", \"read\": {{ "
      "\"source\": \"r{}\" }}, "
      "\"write\": {{ \"result\": \"ldr\" }} }}",
      count - 1);
  return fmt::format("{{ \"resources\": {{ {} }}, \"passes\": [\n{} ], \"present\": \"ldr\" }}", resources,
                     passes);
}

}  // namespace

TEST_CASE("of 1,000 passes with 100 mistakes each mistake is named, and nothing follows from them") {
  const text::Diagnostics said = diagnoseText(chainOf(1000));
  std::map<std::string, int> codes;
  for (const text::Diagnostic& d : said.items()) ++codes[text::nameOf(d.code)];
  INFO(said.text().substr(0, 4000));
  CHECK(said.errorCount() == 100);
  CHECK(said.size() == 100);
  const std::map<std::string, int> expected = {
      {"W042", 20}, {"W040", 20}, {"W022", 20}, {"W051", 20}, {"W048", 20}};
  CHECK(codes == expected);
}

TEST_CASE("a chain without mistakes says nothing") {
  std::string text = chainOf(5);
  CHECK_MESSAGE(diagnoseText(text).empty(), diagnoseText(text).text());
}

TEST_CASE("what an overlay removed, and what a range leaves out, is named where it is missing") {
  const std::string passes =
      R"({ "resources": { "ldr": { "texture": "rgba8", "size": 8 }, "a": { "texture": "rgba8", "size": 8 } },
    "passes": [
      { "name": "fill", "type": "fullscreen", "shader": "a.frag.glsl", "repeat": { "i": [3, 1] }, "write": { "result": "a" } },
      { "name": "show", "type": "fullscreen", "shader": "a.frag.glsl", "read": { "source": "a" }, "write": { "result": "ldr" } } ],
    "present": "ldr" })";
  const text::Diagnostics said = diagnoseText(passes);
  REQUIRE(said.size() == 1);
  CHECK(said.items()[0].code == text::Code::disabledWriter);
  CHECK(said.items()[0].message.find("'fill'") != std::string::npos);
  CHECK(said.items()[0].hint.find("[3, 1, -1]") != std::string::npos);
}

TEST_CASE("a value of the program's own is told from a parameter") {
  const text::Diagnostics said =
      diagnoseText(R"({ "resources": { "a": { "texture": "rgba8", "size": "$screen/2" } }, "passes": [] })");
  REQUIRE(said.errorCount() == 1);
  CHECK(said.items()[0].code == text::Code::unknownVariable);
  CHECK(said.items()[0].hint == "write 'screen', without the '$'");
}

TEST_CASE("an index with a $ is told that it is bare, wherever it stands") {
  const auto said = [](const char* level, const char* gain, const char* enabled) {
    return diagnoseText(fmt::format(
        R"({{ "resources": {{ "a": {{ "texture": "rgba8", "size": 8, "mips": 3 }} }}, "passes": [
        {{ "name": "p", "type": "fullscreen", "shader": "a.frag.glsl", "repeat": {{ "level": [0, 2] }}, "enabled": "{}",
           "write": {{ "result": "a.mip[{}]" }}, "parameters": {{ "gain": "{}" }} }} ], "present": "a.mip[0..]" }})",
        enabled, level, gain));
  };
  CHECK(said("level", "level / 2", "level >= 0").empty());
  for (const auto& found : {said("$level", "1", "true"), said("level", "$level / 2", "true"),
                            said("level", "1", "$level >= 0")}) {
    REQUIRE(found.errorCount() == 1);
    CHECK(found.items()[0].code == text::Code::unknownVariable);
    CHECK(found.items()[0].hint == "write 'level', without the '$'");
  }
}

TEST_CASE("levels that nobody reads are told of") {
  const auto chainRead = [](const char* read) {
    return diagnoseText(fmt::format(
        R"({{ "resources": {{ "ldr": {{ "texture": "rgba8", "size": 8 }}, "glow": {{ "texture": "rgba8", "size": 8, "mips": 4 }} }},
      "passes": [
        {{ "name": "first", "type": "fullscreen", "shader": "a.frag.glsl", "write": {{ "result": "glow.mip[0]" }} }},
        {{ "name": "down", "type": "fullscreen", "shader": "a.frag.glsl", "repeat": {{ "i": [1, 3] }},
           "read": {{ "source": "glow.mip[i-1]" }}, "write": {{ "result": "glow.mip[i]" }} }},
        {{ "name": "show", "type": "fullscreen", "shader": "a.frag.glsl", "read": {{ "source": "{}" }}, "write": {{ "result": "ldr" }} }} ],
      "present": "ldr" }})",
        read));
  };
  CHECK(chainRead("glow").empty());
  CHECK(chainRead("glow.mip[3]").empty());
  CHECK(chainRead("glow.mip[1]").items()[0].message ==
        "pass 'down[3]' is culled: nobody reads what it writes");
  const text::Diagnostics said = chainRead("glow.mip[0]");
  REQUIRE_MESSAGE(said.size() == 1, said.text());
  CHECK(said.items()[0].code == text::Code::culledUnread);
  CHECK(said.items()[0].message == "pass 'down[3]' is culled: nobody reads what it writes");
}

TEST_CASE("a name that an expression asks of and that nothing has is one mistake; has() may mean a pass") {
  const auto enabledBy = [](const char* expression) {
    return diagnoseText(fmt::format(
        R"({{ "resources": {{ "ldr": {{ "texture": "rgba8", "size": 8 }}, "a": {{ "texture": "rgba8", "size": 8 }} }},
      "passes": [
        {{ "name": "blur", "type": "fullscreen", "shader": "a.frag.glsl", "enabled": "{}", "write": {{ "result": "a" }} }},
        {{ "name": "show", "type": "fullscreen", "shader": "a.frag.glsl", "read": {{ "source": "a" }}, "write": {{ "result": "ldr" }} }} ],
      "present": "ldr" }})",
        expression));
  };
  for (const char* each :
       {"has(shwo)", "count(shwo) > 1", "age(shwo) > 1", "has(shwo) && size(shwo).x > 1"}) {
    const text::Diagnostics said = enabledBy(each);
    REQUIRE_MESSAGE(said.size() == 1, said.text());
    CHECK(said.items()[0].code == text::Code::unknownVariable);
    CHECK_MESSAGE(said.items()[0].hint == "did you mean 'show'?", said.text());
  }
}

TEST_CASE("what nothing wrote first is one mistake and no cycle, whoever modifies it after") {
  const auto hint = [](const std::string& passes, const char* code) {
    const text::Diagnostics said = diagnoseText(fmt::format(
        R"J({{ "resources": {{ "hdr": {{ "texture": "rgba16f", "size": 8 }}, "ldr": {{ "texture": "rgba8", "size": 8 }},
          "jagged": {{ "texture": "rgba8", "size": 8 }} }}, "passes": [ {} ], "present": "ldr" }})J",
        passes));
    REQUIRE_MESSAGE(said.size() == 1, said.text());
    CHECK(text::nameOf(said.items()[0].code) == code);
    return said.items()[0].hint;
  };
  const auto pass = [](const char* name, const char* slots) {
    return fmt::format(R"J({{ "name": "{}", "type": "fullscreen", "shader": "a.frag.glsl", {} }})J", name,
                       slots);
  };
  const std::string sky = pass("sky", R"J("write": { "result": "hdr" })J") + ", ";
  CHECK(hint(pass("one", R"J("modify": { "result": "ldr" })J") + ", " +
                 pass("two", R"J("modify": { "result": "ldr" })J"),
             "W059") == "use \"write\" if the pass covers everything, or give 'ldr' a \"clear\"");
  CHECK(hint(sky + pass("copy", R"J("read": { "source": "ldr" }, "write": { "result": "jagged" })J") + ", " +
                 pass("smooth", R"J("read": { "source": "jagged" }, "modify": { "result": "ldr" })J"),
             "W062") == "let a pass before it write it, or give 'ldr' a \"clear\"");
  // A chain of effects without a first.
  CHECK(hint(sky + pass("one", R"J("read": { "source": "ldr" }, "write": { "result": "ldr" })J") + ", " +
                 pass("two", R"J("read": { "source": "ldr" }, "write": { "result": "ldr" })J"),
             "W059")
            .starts_with("give 'ldr' a \"clear\""));
}

TEST_CASE("no fix asks for what a switch has taken out") {
  for (const char* name : {"composite", "post.display"}) {
    text::Diagnostics diagnostics;
    const auto desc = readGraph(WEFT_SOURCE_DIR "/graphs/studio.json", diagnostics);
    REQUIRE(desc);
    expandGraph(*desc, testRegistry(), with({}, {{name}}), diagnostics);
    REQUIRE_MESSAGE(diagnostics.errorCount() == 1, diagnostics.text());
    const std::string& hint = diagnostics.items()[0].hint;
    CHECK(hint.find("disable '") == std::string::npos);  // FXAA writes what is presented
    CHECK(hint.find("enable '") == std::string::npos);
  }
}
