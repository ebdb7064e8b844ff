// Every file of tests/bad_graphs with the stage "shader": a sound graph that does not fit its shader.
#include <doctest/doctest.h>

#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "engine/gl/context/context.h"
#include "engine/gl/context/debug.h"
#include "engine/runtime/frame/renderer.h"
#include "engine/scene/files/scene_file.h"
#include "tests/backend.h"

using namespace weft;

TEST_CASE("graphs that do not fit their shaders are told apart, with their place, and nothing else is said") {
  text::Diagnostics environment;
  auto context = gl::createContext({.backend = gl::test::wantedBackend()}, environment);
  REQUIRE_MESSAGE(context, environment.text());
  auto scene = scene::loadScene(WEFT_SOURCE_DIR "/scenes/one_sphere.json", environment);
  REQUIRE(scene);
  const runtime::World world(std::move(*scene));
  const std::string folder = WEFT_SOURCE_DIR "/tests/bad_graphs/";
  const auto manifest = nlohmann::json::parse(std::ifstream(folder + "manifest.json"));
  int seen = 0;
  for (const auto& entry : manifest.at("files")) {
    if (entry.value("stage", "") != "shader") continue;
    ++seen;
    const std::string file = entry.at("file");
    CAPTURE(file);
    runtime::Renderer renderer(*context, folder + file, {.dataFolder = WEFT_SOURCE_DIR, .cacheFolder = ""});
    text::Diagnostics diagnostics;
    CHECK_FALSE(renderer.load({.screenWidth = 8, .screenHeight = 8, .software = true}, world, diagnostics));
    CAPTURE(diagnostics.text());
    int errors = 0;
    for (const text::Diagnostic& d : diagnostics.items()) {
      if (d.severity != text::Severity::error) continue;
      ++errors;
      CHECK(text::nameOf(d.code) == entry.at("code").get<std::string>());
      CHECK(d.place.line == entry.at("line").get<unsigned>());
      CHECK(d.place.column == entry.at("column").get<unsigned>());
      CHECK(d.pass == "paint");
    }
    CHECK(errors == 1);
  }
  CHECK(seen >= 9);
  CHECK(gl::takeErrors() == "");
}
