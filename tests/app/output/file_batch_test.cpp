// Files that appear together: all of them, or none.
#include "app/output/file_batch.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

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

TEST_CASE("a name that a folder has taken meanwhile is told, and nothing temporary is left") {
  const TemporaryFolder folder;
  const std::string blocked = folder.at("blocked.txt");
  base::Diagnostics diagnostics;
  {
    FileBatch batch;
    REQUIRE(batch.writeText(blocked, "no", diagnostics));
    fs::create_directories(blocked + "/inside");
    CHECK_FALSE(batch.publish(diagnostics));
  }
  REQUIRE(diagnostics.size() == 1);
  CHECK(diagnostics.items()[0].code == base::Code::outputNotWritten);
  CHECK(diagnostics.items()[0].message.find("blocked.txt'") != std::string::npos);
  CHECK(countOf(folder) == 2);
}

TEST_CASE("files to be removed are gone once the others are there") {
  const TemporaryFolder folder;
  const std::string old = folder.write("old.txt", "old"), behind = folder.write("behind.txt", "behind"),
                    link = folder.at("link.txt"), made = folder.at("made.txt");
  fs::create_symlink(behind, link);
  {
    base::Diagnostics diagnostics;
    FileBatch batch;
    batch.remove(old);
    batch.remove(link);
    batch.remove(folder.at("none.txt"));
    REQUIRE(batch.writeText(made, "made", diagnostics));
    REQUIRE(batch.publish(diagnostics));
    CHECK_FALSE(fs::exists(old));
    CHECK_FALSE(fs::is_symlink(fs::symlink_status(link)));
    CHECK(contentOf(behind) == "behind");
  }
  CHECK(countOf(folder) == 2);
}

TEST_CASE("what an earlier process of the same number kept is not written over") {
  const TemporaryFolder folder;
  base::Diagnostics diagnostics;
  FileBatch batch;
  std::string temporary;
  const auto write = [&](const std::string& path, base::Diagnostics&) {
    temporary = path;
    return true;
  };
  REQUIRE(batch.write(folder.at("first.txt"), write, diagnostics));
  const std::size_t dot = temporary.rfind('.');
  const int number = std::stoi(temporary.substr(dot + 1));
  std::vector<std::string> kept;
  for (int i = 1; i <= 4; ++i)
    kept.push_back(folder.write(
        fs::path(temporary.substr(0, dot)).filename().string() + fmt::format(".{}", number + i), "kept"));
  const std::string old = folder.write("old.txt", "before");
  FileBatch other;
  REQUIRE(other.writeText(old, "after", diagnostics));
  REQUIRE(other.writeText(folder.at("new.txt"), "new", diagnostics));
  REQUIRE(other.publish(diagnostics));
  for (const std::string& path : kept) CHECK(contentOf(path) == "kept");
  CHECK(contentOf(old) == "after");
  CHECK(countOf(folder) == kept.size() + 2);
}
