#include "engine/text/files/file.h"

#include <doctest/doctest.h>

#include <cerrno>
#include <filesystem>
#include <iterator>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "engine/text/files/pending_file.h"
#include "engine/text/hash.h"
#include "tests/temporary_folder.h"

using namespace weft::text;

TEST_CASE("a missing file, a directory and an unwritable place are told apart") {
  Diagnostics all;
  CHECK_FALSE(readFile("no/such/file", all));
  CHECK_FALSE(readFile(std::filesystem::temp_directory_path().string(), all, Code::unreadableImage));
  CHECK_FALSE(writeFile("/no_such_folder/x", std::string_view("x"), all));
  REQUIRE(all.size() == 3);
  CHECK(all.items()[0].message.find("no such file") != std::string::npos);
  CHECK(all.items()[1].code == Code::unreadableImage);
  CHECK(all.items()[1].message.find("directory") != std::string::npos);
  CHECK(all.items()[2].code == Code::outputNotWritten);
}

TEST_CASE("a name may be as long as the file system takes it") {
  const TemporaryFolder folder;
  const std::string longest(255, 'n');
  Diagnostics all;
  for (const char* text : {"one", "two"}) {
    REQUIRE_MESSAGE(writeFile(folder.at(longest), std::string_view(text), all), all.text());
    CHECK(readFile(folder.at(longest), all) == text);
  }
  CHECK_FALSE(writeFile(folder.at(longest + "n"), std::string_view("x"), all));
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path()),
                      std::filesystem::directory_iterator()) == 1);
}

TEST_CASE("a device is not read: /dev/zero has no end") {
  Diagnostics all;
  CHECK_FALSE(readFile("/dev/zero", all));
  REQUIRE(all.size() == 1);
  CHECK(all.items()[0].message.find("device") != std::string::npos);
}

TEST_CASE("a file above 4 GiB is refused before it is read") {
  namespace fs = std::filesystem;
  const TemporaryFolder folder;
  const fs::path path = folder.at("large.bin");
  Diagnostics all;
  REQUIRE(writeFile(path, std::string_view("x"), all));
  fs::resize_file(path, (std::uintmax_t{4} << 30) + 1);  // takes no room: it has a hole
  CHECK_FALSE(readFile(path, all, Code::unreadableImage));
  REQUIRE(all.size() == 1);
  CHECK(all.items()[0].code == Code::unreadableImage);
  CHECK(all.items()[0].message.ends_with("it is larger than 4 GiB"));
}

TEST_CASE("writing keeps permissions, and a link leads to what was written") {
  namespace fs = std::filesystem;
  const TemporaryFolder temporary;
  const fs::path& folder = temporary.path();
  Diagnostics all;
  REQUIRE(writeFile(folder / "real", std::string_view("old"), all));
  fs::permissions(folder / "real", fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_write);
  fs::create_symlink("real", folder / "link");
  REQUIRE(writeFile(folder / "link", std::string_view("new"), all));
  CHECK(fs::is_symlink(folder / "link"));
  CHECK(readFile(folder / "real", all) == "new");
  CHECK(fs::status(folder / "real").permissions() ==
        (fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_write));
}

TEST_CASE("what a killed process left beside a file is replaced, a link there is not followed") {
  const TemporaryFolder folder;
  const std::string other = folder.write("other", "other"), beside = folder.at(".a.part");
  Diagnostics all;
  std::filesystem::create_symlink(other, beside);
  REQUIRE_MESSAGE(writeFile(folder.at("a"), std::string_view("one"), all), all.text());
  folder.write(".a.part", "left");
  REQUIRE_MESSAGE(writeFile(folder.at("a"), std::string_view("two"), all), all.text());
  CHECK(readFile(folder.at("a"), all) == "two");
  CHECK(readFile(other, all) == "other");
  CHECK_FALSE(std::filesystem::exists(beside));
}

TEST_CASE("a file that is under way is beside its place, and only one process writes it") {
  const TemporaryFolder folder;
  Diagnostics all;
  REQUIRE(writeFile(folder.at("a"), std::string_view("old"), all));
  {
    PendingFile file(folder.at("a"));
    CHECK(file.write(std::string_view("half")));
    CHECK(file.name() == folder.at(".a.part"));
    CHECK(PendingFile(folder.at("a"), false).error() == EWOULDBLOCK);
    CHECK(readFile(file.name(), all) == "half");
    CHECK(readFile(folder.at("a"), all) == "old");
  }
  CHECK_FALSE(std::filesystem::exists(folder.at(".a.part")));
  // Many at once: each waits for the others, and one of them is the last.
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i)
    threads.emplace_back([&, text = std::string(100'000, static_cast<char>('a' + i))] {
      Diagnostics said;
      for (int k = 0; k < 20; ++k) CHECK_MESSAGE(writeFile(folder.at("a"), text, said), said.text());
    });
  for (std::thread& thread : threads) thread.join();
  const auto text = readFile(folder.at("a"), all);
  REQUIRE(text);
  CHECK(*text == std::string(100'000, text->front()));
  CHECK_FALSE(std::filesystem::exists(folder.at(".a.part")));
}

TEST_CASE("what is written is read back") {
  const TemporaryFolder folder;
  const std::string path = folder.at("some.bin");
  Diagnostics all;
  const std::string bytes("a\0b", 3);
  REQUIRE(writeFile(path, bytes, all));
  CHECK(readFile(path, all) == bytes);
}
