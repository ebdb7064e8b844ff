// Files that appear together: all of them, or none.
#include "app/output/file_batch.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "tests/temporary_folder.h"

using namespace weft;
using namespace weft::app;
namespace fs = std::filesystem;

namespace {

// What somebody else does between two steps of a batch: right before its rename number `at`, counted from 0.
struct Meanwhile {
  int at = -1;
  std::function<void()> act{};
};
Meanwhile meanwhile;
bool hardLinks = true;  // whether the disk has them

}  // namespace

// In place of the ones of the C library, also where the standard library calls them.
extern "C" int rename(const char* from, const char* to) noexcept {
  if (meanwhile.at-- == 0) meanwhile.act();
  return static_cast<int>(::syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

extern "C" int link(const char* from, const char* to) noexcept {
  if (hardLinks) return ::linkat(AT_FDCWD, from, AT_FDCWD, to, 0);
  errno = EPERM;
  return -1;
}

namespace {

// A folder with something in it, where a file was.
void putFolder(const std::string& path) {
  fs::remove(path);
  fs::create_directories(path + "/inside");
}

std::string contentOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// A batch that is to fail: it writes one file over another, makes a new one, and then finds its last place taken.
struct Blocked {
  TemporaryFolder folder;
  std::string old = folder.write("old.txt", "before"), blocked = folder.at("blocked.txt");
  base::Diagnostics diagnostics;

  // `made`: the new file. `block` is what somebody else does once all are written.
  void publish(const std::string& made, const std::function<void()>& block) {
    FileBatch batch;
    REQUIRE(batch.writeText(old, "after", diagnostics));
    REQUIRE(batch.writeText(made, "made", diagnostics));
    REQUIRE(batch.writeText(blocked, "no", diagnostics));
    block();
    CHECK_FALSE(batch.publish(diagnostics));
  }

  // The only message.
  const base::Diagnostic& said() const {
    REQUIRE(diagnostics.size() == 1);
    CHECK(diagnostics.items()[0].code == base::Code::outputNotWritten);
    return diagnostics.items()[0];
  }
};

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
  Blocked test;
  test.publish(test.folder.at("new/file.txt"), [&] { fs::create_directory(test.blocked); });
  CHECK(test.said().message.find("blocked.txt'") != std::string::npos);
  CHECK(test.said().found.empty());  // nothing is replaced
  CHECK(contentOf(test.old) == "before");
  CHECK(countOf(test.folder) == 2);
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

TEST_CASE("what cannot be put back is kept, and the message says where") {
  Blocked test;
  const std::string made = test.folder.at("made.txt");
  test.publish(made, [&] {
    meanwhile = {2, [&] {
                   for (const std::string& path : {test.old, made, test.blocked}) putFolder(path);
                 }};
  });
  const base::Diagnostic& said = test.said();
  const std::string begin =
      fmt::format("'{}' is written, and cannot be removed; '{}' cannot be put back, and what it was is in '",
                  made, test.old);
  REQUIRE_MESSAGE(said.found.starts_with(begin), said.found);
  CHECK(contentOf(said.found.substr(begin.size(), said.found.size() - begin.size() - 1)) == "before");
  CHECK(said.hint.find("by hand") != std::string::npos);
  CHECK(countOf(test.folder) == 7);  // three folders with one inside each, and what is kept
}

TEST_CASE("without hard links, what is replaced is copied first; on a full disk nothing is replaced") {
  const TemporaryFolder folder;
  const std::string content(5000, 'o'), old = folder.write("old.txt", content),
                                        blocked = folder.at("blocked.txt");
  std::signal(SIGXFSZ, SIG_IGN);
  hardLinks = false;
  for (const bool full : {false, true}) {
    CAPTURE(full);
    base::Diagnostics diagnostics;
    rlimit before{};
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
    const rlimit small{1000, before.rlim_max};
    {
      FileBatch batch;
      REQUIRE(batch.writeText(old, "after", diagnostics));
      REQUIRE(batch.writeText(blocked, "no", diagnostics));
      if (!full) putFolder(blocked);
      if (full) ::setrlimit(RLIMIT_FSIZE, &small);
      const bool published = batch.publish(diagnostics);
      ::setrlimit(RLIMIT_FSIZE, &before);
      CHECK_FALSE(published);
    }
    REQUIRE(diagnostics.size() == 1);
    CHECK(diagnostics.items()[0].message.find(full ? "old.txt'" : "blocked.txt'") != std::string::npos);
    CHECK(diagnostics.items()[0].found.empty());
    CHECK(contentOf(old) == content);
    fs::remove_all(blocked);
    CHECK(countOf(folder) == 1);
  }
  hardLinks = true;
}

TEST_CASE("files to be removed are gone once the others are there, and stay when they are not") {
  const TemporaryFolder folder;
  const std::string old = folder.write("old.txt", "old"), behind = folder.write("behind.txt", "behind"),
                    link = folder.at("link.txt"), made = folder.at("made.txt");
  fs::create_symlink(behind, link);
  for (const bool blocked : {true, false}) {
    CAPTURE(blocked);
    base::Diagnostics diagnostics;
    FileBatch batch;
    batch.remove(old);
    batch.remove(link);
    batch.remove(folder.at("none.txt"));
    REQUIRE(batch.writeText(made, "made", diagnostics));
    if (blocked) putFolder(made);
    CHECK(batch.publish(diagnostics) == !blocked);
    if (blocked) fs::remove_all(made);
    CHECK(fs::exists(old) == blocked);
    CHECK(fs::is_symlink(fs::symlink_status(link)) == blocked);
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
