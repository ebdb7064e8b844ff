// Files that appear together: all of them, or none.
#include "app/output/file_batch.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/temporary_folder.h"

using namespace weft;
using namespace weft::app;
namespace fs = std::filesystem;

namespace {

std::string contentOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Of everything below a folder, hidden files too.
std::size_t countOf(const TemporaryFolder& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::recursive_directory_iterator(folder.path()), fs::recursive_directory_iterator()));
}

}  // namespace

TEST_CASE("files appear when all are written, over what was there, also by the longest names") {
  const TemporaryFolder folder;
  const std::string longest = folder.at(std::string(255, 'n')), old = folder.write("old.txt", "before");
  fs::permissions(old, fs::perms::owner_read | fs::perms::owner_write);
  base::Diagnostics diagnostics;
  FileBatch batch;
  REQUIRE_MESSAGE(batch.writeText(old, "after", diagnostics), diagnostics.text());
  REQUIRE_MESSAGE(batch.writeText(longest, "long", diagnostics), diagnostics.text());
  REQUIRE(batch.writeText(folder.at("new/file.txt"), "new", diagnostics));
  CHECK(contentOf(old) == "before");
  CHECK_FALSE(fs::exists(longest));
  REQUIRE_MESSAGE(batch.publish(diagnostics), diagnostics.text());
  CHECK(contentOf(old) == "after");
  CHECK(contentOf(longest) == "long");
  CHECK(contentOf(folder.at("new/file.txt")) == "new");
  CHECK(fs::status(old).permissions() == (fs::perms::owner_read | fs::perms::owner_write));
  CHECK(countOf(folder) == 4);
}

TEST_CASE("a rename that fails undoes those before it") {
  const TemporaryFolder folder;
  const std::string old = folder.write("old.txt", "before"), blocked = folder.at("blocked.txt");
  base::Diagnostics diagnostics;
  {
    FileBatch batch;
    REQUIRE(batch.writeText(old, "after", diagnostics));
    REQUIRE(batch.writeText(folder.at("new/file.txt"), "new", diagnostics));
    REQUIRE(batch.writeText(blocked, "no", diagnostics));
    fs::create_directory(blocked);  // by somebody else, meanwhile
    CHECK_FALSE(batch.publish(diagnostics));
  }
  REQUIRE(diagnostics.size() == 1);
  CHECK(diagnostics.items()[0].code == base::Code::outputNotWritten);
  CHECK(diagnostics.items()[0].message.find("blocked.txt'") != std::string::npos);
  CHECK(diagnostics.items()[0].found.empty());  // nothing is replaced
  CHECK(contentOf(old) == "before");
  CHECK(countOf(folder) == 2);
}

TEST_CASE("files that are not published leave nothing") {
  const TemporaryFolder folder;
  base::Diagnostics diagnostics;
  {
    FileBatch batch;
    REQUIRE(batch.writeText(folder.at("a/b/c.txt"), "c", diagnostics));
    CHECK(countOf(folder) == 3);
  }
  CHECK(countOf(folder) == 0);
}
