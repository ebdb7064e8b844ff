#include "engine/assets/material_library.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "tests/skip.h"
#include "tests/temporary_folder.h"

using namespace weft;
using namespace weft::assets;

namespace {

const std::string kPath = WEFT_SOURCE_DIR "/materials/pbr_materials.json";

MaterialLibrary loadOurs() {
  base::Diagnostics diagnostics;
  auto library = loadMaterialLibrary(kPath, diagnostics);
  REQUIRE_MESSAGE(library, diagnostics.text());
  CHECK(diagnostics.empty());
  return *library;
}

base::Diagnostic libraryFailureOf(std::string_view text) {
  base::Diagnostics diagnostics;
  CHECK_FALSE(readMaterialLibrary(text, "m.json", diagnostics));
  REQUIRE_MESSAGE(diagnostics.size() == 1, diagnostics.text());
  return diagnostics.items()[0];
}

}  // namespace

TEST_CASE("our library: at least 101 presets in nine categories, in range, unique, each with its source") {
  const MaterialLibrary library = loadOurs();
  CHECK(library.materials.size() >= 101);
  CHECK(std::set<std::string>(library.categories.begin(), library.categories.end()) ==
        std::set<std::string>{"pure metals", "weathered metals", "glossy dielectrics", "matte",
                              "stones and minerals", "organics", "paint and coatings", "technical",
                              "anodized and patina"});
  std::set<std::string> names;
  int measured = 0;
  for (const MaterialPreset& m : library.materials) {
    CHECK(names.insert(m.name).second);
    for (const float a : m.albedo) CHECK((a >= 0 && a <= 1));
    CHECK((m.metallic >= 0 && m.metallic <= 1));
    CHECK((m.roughness >= 0 && m.roughness <= 1));
    const bool isMeasured = m.source.starts_with("measured: "),
               isEstimated = m.source.starts_with("estimated: ");
    CHECK_MESSAGE((isMeasured || isEstimated), m.name);
    measured += isMeasured;
    if (m.category == "pure metals") CHECK(m.metallic == 1);
    if (m.category == "matte") CHECK((m.metallic == 0 && m.roughness >= 0.5f));
    if (m.category == "glossy dielectrics") CHECK((m.metallic == 0 && m.roughness <= 0.3f));
  }
  CHECK(measured >= 30);
  for (const std::string& category : library.categories)
    CHECK(std::count_if(library.materials.begin(), library.materials.end(),
                        [&](const auto& m) { return m.category == category; }) >= 10);
}

TEST_CASE(
    "gold, silver and copper agree with Fresnel's formula and the n and k of Johnson and Christy (1972)") {
  struct Row {
    const char* name;
    std::array<std::array<double, 2>, 3> nk;  // at 616.8, 548.6 and 450.9 nm
  };
  const MaterialLibrary library = loadOurs();
  for (const Row& row : {Row{"Gold", {{{0.21, 3.272}, {0.43, 2.455}, {1.38, 1.914}}}},
                         Row{"Silver", {{{0.06, 4.152}, {0.06, 3.586}, {0.04, 2.657}}}},
                         Row{"Copper", {{{0.30, 3.205}, {1.02, 2.577}, {1.24, 2.397}}}}}) {
    const MaterialPreset* m = library.find(row.name);
    REQUIRE(m);
    for (std::size_t c = 0; c < 3; ++c) {
      const double n = row.nk[c][0], k = row.nk[c][1];
      const double f0 = ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k);
      // Three wavelengths stand for the whole visible and the primaries are no spectral lines: hence 0.08.
      CHECK_MESSAGE(std::abs(f0 - static_cast<double>(m->albedo[c])) < 0.08,
                    row.name << " " << c << ": " << f0);
    }
  }
}

TEST_CASE("presets are found by name") {
  const MaterialLibrary library = loadOurs();
  CHECK(library.find("Charcoal")->albedo[0] == 0.04f);
  CHECK(library.find("Fresh Snow")->albedo[1] == 0.81f);
  CHECK(library.find("fresh snow") == nullptr);
  CHECK(library.names().size() == library.materials.size());
}

TEST_CASE("category and source may be absent") {
  base::Diagnostics diagnostics;
  const auto library = readMaterialLibrary(
      R"([{"name": "a", "albedo": [0, 0.5, 1], "metallic": 0, "roughness": 1}])", "m.json", diagnostics);
  REQUIRE(library);
  CHECK(library->materials[0].albedo == std::array<float, 3>{0, 0.5f, 1});
}

TEST_CASE("the hundred materials of the studio's model load" * doctest::test_suite("references")) {
  const char* folder = std::getenv("WEFT_REFERENCES");
  if (!folder) return weft::test::skipCase("no references: set WEFT_REFERENCES=FOLDER");
  const std::string seed = std::string(folder) + "/seed_materials.json";
  base::Diagnostics diagnostics;
  const auto library = loadMaterialLibrary(seed, diagnostics);
  REQUIRE_MESSAGE(library, diagnostics.text());
  CHECK(library->materials.size() == 100);
}

TEST_CASE("every mistake is reported with its place") {
  const auto with = [](const char* rest) {
    return std::string("[\n  {\"name\": \"a\", \"metallic\": 0, \"roughness\": 0, ") + rest + "}\n]";
  };
  CHECK(libraryFailureOf("[").code == base::Code::notJson);
  CHECK(libraryFailureOf("{}").code == base::Code::wrongType);
  CHECK(libraryFailureOf("[3]").code == base::Code::wrongType);
  const base::Diagnostic range = libraryFailureOf(with("\"albedo\": [0, 1.5, 0]"));
  CHECK(range.code == base::Code::badMaterialValue);
  CHECK(range.place.line == 2);
  CHECK(range.place.column > 50);
  CHECK(range.pointer == "/0/albedo/1");
  CHECK(libraryFailureOf(with("\"albedo\": [0, 1]")).code == base::Code::wrongType);
  CHECK(libraryFailureOf(with("\"albedo\": [0, 1, \"x\"]")).code == base::Code::wrongType);
  const base::Diagnostic unknown = libraryFailureOf(with("\"albedo\": [0, 0, 0], \"sorce\": \"x\""));
  CHECK(unknown.code == base::Code::unknownKey);
  CHECK(unknown.hint == "did you mean 'source'?");
}

TEST_CASE("duplicate names are errors, and all problems come at once") {
  base::Diagnostics diagnostics;
  CHECK_FALSE(readMaterialLibrary(R"([
    {"name": "a", "albedo": [0, 0, 0], "metallic": 0, "roughness": 0},
    {"name": "a", "albedo": [0, 0, 0], "metallic": 2, "roughness": 0}
  ])",
                                  "m.json", diagnostics));
  CHECK(diagnostics.errorCount() == 2);
  CHECK(diagnostics.contains(base::Code::badMaterialValue));
  CHECK(diagnostics.contains(base::Code::duplicateMaterial));
}

TEST_CASE("a library whose values are all out of range is not reported value by value") {
  std::string text = "[";
  for (int i = 0; i < 40; ++i)
    text += (i ? ",\n" : "\n") + std::string("{\"name\": \"") + std::to_string(i) +
            "\", \"albedo\": [255, 128, 0], \"metallic\": 0, \"roughness\": 0}";
  base::Diagnostics diagnostics;
  CHECK_FALSE(readMaterialLibrary(text + "]", "m.json", diagnostics));
  CHECK(diagnostics.errorCount() == 12);
  REQUIRE(diagnostics.size() == 13);
  CHECK(diagnostics.items()[12].severity == base::Severity::note);
  CHECK(diagnostics.items()[12].message == "and 68 more values out of range in this file");
}
