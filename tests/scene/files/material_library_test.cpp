#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/scene/files/scene_file.h"
#include "tests/skip.h"
#include "tests/temporary_folder.h"

using namespace weft;
using namespace weft::scene;

namespace {

const std::string kPath = WEFT_SOURCE_DIR "/materials/pbr_materials.json";

std::string textOf(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<Material> loadOurs() {
  text::Diagnostics diagnostics;
  auto library = readMaterialLibrary(textOf(kPath), kPath, diagnostics);
  REQUIRE_MESSAGE(library, diagnostics.text());
  CHECK(diagnostics.empty());
  return *library;
}

text::Diagnostic libraryFailureOf(std::string_view text) {
  text::Diagnostics diagnostics;
  CHECK_FALSE(readMaterialLibrary(text, "m.json", diagnostics));
  REQUIRE_MESSAGE(diagnostics.size() == 1, diagnostics.text());
  return diagnostics.items()[0];
}

}  // namespace

TEST_CASE("our library: at least 101 presets in nine categories, in range, unique, each with its source") {
  const std::vector<Material> library = loadOurs();
  CHECK(library.size() >= 101);
  const nlohmann::json rows = nlohmann::json::parse(textOf(kPath), nullptr, true, true);
  REQUIRE(rows.size() == library.size());
  std::set<std::string> names;
  std::map<std::string, int> categories;
  int measured = 0;
  for (std::size_t i = 0; i < library.size(); ++i) {
    const Material& m = library[i];
    const std::string category = rows[i]["category"], source = rows[i]["source"];
    CHECK(names.insert(m.name).second);
    for (int c = 0; c < 3; ++c) CHECK((m.albedo[c] >= 0 && m.albedo[c] <= 1));
    CHECK((m.metallic >= 0 && m.metallic <= 1));
    CHECK((m.roughness >= 0 && m.roughness <= 1));
    CHECK_MESSAGE((source.starts_with("measured: ") || source.starts_with("estimated: ")), m.name);
    measured += source.starts_with("measured: ");
    ++categories[category];
    if (category == "pure metals") CHECK(m.metallic == 1);
    if (category == "matte") CHECK((m.metallic == 0 && m.roughness >= 0.5f));
    if (category == "glossy dielectrics") CHECK((m.metallic == 0 && m.roughness <= 0.3f));
  }
  CHECK(measured >= 30);
  CHECK(categories.size() == 9);
  for (const auto& [category, count] : categories) CHECK_MESSAGE(count >= 10, category);
}

TEST_CASE(
    "gold, silver and copper agree with Fresnel's formula and the n and k of Johnson and Christy (1972)") {
  struct Row {
    const char* name;
    std::array<std::array<double, 2>, 3> nk;  // at 616.8, 548.6 and 450.9 nm
  };
  const std::vector<Material> library = loadOurs();
  for (const Row& row : {Row{"Gold", {{{0.21, 3.272}, {0.43, 2.455}, {1.38, 1.914}}}},
                         Row{"Silver", {{{0.06, 4.152}, {0.06, 3.586}, {0.04, 2.657}}}},
                         Row{"Copper", {{{0.30, 3.205}, {1.02, 2.577}, {1.24, 2.397}}}}}) {
    const auto m = std::ranges::find(library, row.name, &Material::name);
    REQUIRE(m != library.end());
    for (std::size_t c = 0; c < 3; ++c) {
      const double n = row.nk[c][0], k = row.nk[c][1];
      const double f0 = ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k);
      // Three wavelengths stand for the whole visible and the primaries are no spectral lines: hence 0.08.
      CHECK_MESSAGE(std::abs(f0 - static_cast<double>(m->albedo[static_cast<int>(c)])) < 0.08,
                    row.name << " " << c << ": " << f0);
    }
  }
}

TEST_CASE("category and source may be absent") {
  text::Diagnostics diagnostics;
  const auto library = readMaterialLibrary(
      R"([{"name": "a", "albedo": [0, 0.5, 1], "metallic": 0, "roughness": 1}])", "m.json", diagnostics);
  REQUIRE(library);
  CHECK((*library)[0].albedo == glm::vec3(0, 0.5f, 1));
}

TEST_CASE("the hundred materials of the studio's model load" * doctest::test_suite("references")) {
  const char* folder = std::getenv("WEFT_REFERENCES");
  if (!folder) return weft::test::skipCase("no references: set WEFT_REFERENCES=FOLDER");
  const std::string seed = std::string(folder) + "/seed_materials.json";
  text::Diagnostics diagnostics;
  const auto library = readMaterialLibrary(textOf(seed), seed, diagnostics);
  REQUIRE_MESSAGE(library, diagnostics.text());
  CHECK(library->size() == 100);
}

TEST_CASE("every mistake is reported with its place") {
  const auto with = [](const char* rest) {
    return std::string("[\n  {\"name\": \"a\", \"metallic\": 0, \"roughness\": 0, ") + rest + "}\n]";
  };
  CHECK(libraryFailureOf("[").code == text::Code::notJson);
  CHECK(libraryFailureOf("{}").code == text::Code::wrongType);
  CHECK(libraryFailureOf("[3]").code == text::Code::wrongType);
  const text::Diagnostic range = libraryFailureOf(with("\"albedo\": [0, 1.5, 0]"));
  CHECK(range.code == text::Code::badMaterialValue);
  CHECK(range.place.line == 2);
  CHECK(range.place.column > 50);
  CHECK(libraryFailureOf(with("\"albedo\": [0, 1]")).code == text::Code::wrongType);
  CHECK(libraryFailureOf(with("\"albedo\": [0, 1, \"x\"]")).code == text::Code::wrongType);
  const text::Diagnostic unknown = libraryFailureOf(with("\"albedo\": [0, 0, 0], \"sorce\": \"x\""));
  CHECK(unknown.code == text::Code::unknownKey);
  CHECK(unknown.hint == "did you mean 'source'?");
}

TEST_CASE("duplicate names are errors, and all problems come at once") {
  text::Diagnostics diagnostics;
  CHECK_FALSE(readMaterialLibrary(R"([
    {"name": "a", "albedo": [0, 0, 0], "metallic": 0, "roughness": 0},
    {"name": "a", "albedo": [0, 0, 0], "metallic": 2, "roughness": 0}
  ])",
                                  "m.json", diagnostics));
  CHECK(diagnostics.errorCount() == 2);
  CHECK(diagnostics.contains(text::Code::badMaterialValue));
  CHECK(diagnostics.contains(text::Code::duplicateMaterial));
}
