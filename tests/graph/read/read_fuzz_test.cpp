// Damaged text: every prefix and thousands of random byte changes of real graphs, and random soups of tokens.
// Whatever comes, the reader answers with a description or with errors at places inside the file. Fixed
// seeds.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "engine/graph/read/read.h"
#include "engine/graph/read/ref_parse.h"
#include "tests/graph/language/expr_text.h"

using namespace weft::graph;
using weft::text::Diagnostics;

namespace {

std::vector<std::string> realGraphs() {
  std::vector<std::string> out;
  for (const char* folder : {WEFT_SOURCE_DIR "/graphs", WEFT_SOURCE_DIR "/tests/graph/paper"}) {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (entry.path().extension() == ".json") paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    for (const auto& path : paths) {
      std::ifstream in(path, std::ios::binary);
      out.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    }
  }
  return out;
}

// True when it read without errors.
bool feed(const std::string& text) {
  Diagnostics diagnostics;
  const auto graph = readGraphText(text, "nowhere/fuzz.json", diagnostics);
  const auto lines = static_cast<std::uint32_t>(std::count(text.begin(), text.end(), '\n')) + 1;
  bool good = graph || diagnostics.hasErrors();
  for (const auto& d : diagnostics.items())
    good = good && d.place.file && d.place.line >= 1 && d.place.line <= lines && d.place.column >= 1;
  CHECK_MESSAGE(good, text, "\n", diagnostics.text());
  return !diagnostics.hasErrors();
}

}  // namespace

TEST_CASE("every prefix of a real graph is an error") {
  const std::vector<std::string> graphs = realGraphs();
  REQUIRE(!graphs.empty());
  std::size_t good = 0, prefixes = 0;
  for (const std::string& text : graphs) {
    const std::size_t end = text.find_last_of('}');
    for (std::size_t length = 0; length <= end; ++length, ++prefixes)
      good += feed(text.substr(0, length)) ? 1 : 0;
  }
  CHECK(good == 0);
  MESSAGE(prefixes << " prefixes of " << graphs.size() << " graphs");
}

TEST_CASE("random damage is answered") {
  const std::vector<std::string> graphs = realGraphs();
  REQUIRE(!graphs.empty());
  const std::string alphabet = "{}[]\",:$@?!.<>=&|+-*/%() \n\\0123456789aeilmnprtuxyz_\x80\xC3\xA9\xFF\x01";
  std::mt19937 random(20240607);
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  std::size_t good = 0;
  constexpr int kRounds = 4000;
  for (int round = 0; round < kRounds; ++round) {
    std::string text = graphs[below(graphs.size())];
    for (std::size_t edits = 1 + below(3); edits > 0; --edits) {
      const std::size_t at = below(text.size());
      switch (below(4)) {
        case 0:
          text[at] = alphabet[below(alphabet.size())];
          break;
        case 1:
          text.erase(at, 1 + below(4));
          break;
        case 2:
          text.insert(at, 1, alphabet[below(alphabet.size())]);
          break;
        default:
          text.insert(at, text.substr(below(text.size()), 1 + below(30)));
      }
      if (text.empty()) text = " ";
    }
    good += feed(text) ? 1 : 0;
  }
  CHECK(good < kRounds);
}

TEST_CASE("random soups of tokens: expressions print as what they parse to, references never crash") {
  const std::vector<std::string> tokens = {"1",         "2.5",
                                           "$a",        "$p.q",
                                           "i",         "size(x)",
                                           "age(@x.y)", "has(",
                                           "min(",      "ceil(",
                                           ")",         "(",
                                           "[",         "]",
                                           ",",         "+",
                                           "-",         "*",
                                           "/",         "%",
                                           "<",         "<=",
                                           "==",        "!=",
                                           "&&",        "||",
                                           "!",         "?",
                                           ":",         ".x",
                                           ".",         "true",
                                           "screen",    "device.software",
                                           " ",         "@",
                                           "@-1",       ".mip[",
                                           "..",        " as ",
                                           " if ",      "linear",
                                           "\xC3\xA9",  "$"};
  std::mt19937 random(7);
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  const Place place{"soup", 1, 1};
  int parsed = 0;
  for (int round = 0; round < 30000; ++round) {
    std::string text;
    for (std::size_t n = 1 + below(9); n > 0; --n) text += tokens[below(tokens.size())];
    Diagnostics diagnostics;
    const auto expr = Expr::parse(text, place, diagnostics);
    CHECK(expr.has_value() == diagnostics.empty());
    for (const auto& d : diagnostics.items())
      CHECK_MESSAGE((d.place.column >= 1 && d.place.column <= text.size() + 1), text);
    if (expr) {
      ++parsed;
      Diagnostics again;
      const auto copy = Expr::parse(textOf(*expr), place, again);
      REQUIRE_MESSAGE(copy, text, " -> ", textOf(*expr));
      CHECK_MESSAGE(textOf(*copy) == textOf(*expr), text);
    }
    Diagnostics said;
    const bool isRef = parseRef(text, place, said).has_value();
    CHECK_MESSAGE(isRef == said.empty(), text);
    for (const auto& d : said.items())
      CHECK_MESSAGE((d.place.column >= 1 && d.place.column <= text.size() + 1), text);
    looksLikeRef(text);
    parseCallText(text, place, said);
  }
  CHECK(parsed > 1000);
}
