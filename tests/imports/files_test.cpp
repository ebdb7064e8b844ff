#include <doctest/doctest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "engine/assets/cube_lut.h"
#include "engine/imports/world.h"
#include "engine/text/files/file_cache.h"
#include "tests/temporary_folder.h"

using namespace weft;
using namespace weft::imports;

TEST_CASE("a table is parsed once, again when its file changed, and its mistakes are said each time") {
  const TemporaryFolder folder;
  const std::string path = folder.at("a.cube");
  const auto write = [&](const std::string& text) { std::ofstream(path) << text; };
  Files files;
  const auto table = [&](text::Diagnostics& said) {
    return files.get<assets::CubeLut>(path, assets::loadCubeLut, said);
  };
  text::Diagnostics diagnostics;
  for (int i = 0; i < 2; ++i) {
    CHECK(!table(diagnostics));
    CHECK(diagnostics.contains(text::Code::unreadableFile));
    diagnostics.clear();
  }
  write("LUT_1D_SIZE 2\n0 0 0\n1 1 1\n");
  const auto first = table(diagnostics);
  REQUIRE(first);
  CHECK(table(diagnostics) == first);
  write("LUT_3D_SIZE 2\n" + std::string("0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n"));
  const auto second = table(diagnostics);
  REQUIRE(second);
  CHECK(second->dimensions == 3);
  CHECK(first->dimensions == 1);  // who holds it keeps it
  // The same length at another time.
  std::filesystem::last_write_time(path, std::filesystem::last_write_time(path) + std::chrono::seconds(2));
  CHECK(table(diagnostics) != second);
  CHECK(diagnostics.empty());
  write("LUT_3D_SIZE 2\n0 0 0\n");
  for (int i = 0; i < 2; ++i) {
    CHECK(!table(diagnostics));
    CHECK(diagnostics.errorCount() == 1);
    diagnostics.clear();
  }
  CHECK(files.touched() == std::set{path});
  files.forgetTouched();
  CHECK(files.touched().empty());
}
