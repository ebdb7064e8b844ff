#include <doctest/doctest.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <vector>

#include "engine/gl/programs/program_cache.h"
#include "tests/temporary_folder.h"

using namespace weft::gl;
namespace fs = std::filesystem;

namespace {

std::string nameOf(int i) {
  return fmt::format("{:032x}.bin", i);
}

std::string bytesFor(std::size_t size) {
  return std::string(size, 'x');
}

void touch(const std::string& path) {
  std::error_code gone;
  fs::last_write_time(path, fs::file_time_type::clock::now(), gone);
}

std::uint64_t bytesIn(const std::string& folder) {
  std::uint64_t bytes = 0;
  for (const auto& entry : fs::directory_iterator(folder)) bytes += entry.file_size();
  return bytes;
}

// File i was used i minutes after the first.
void fill(TemporaryFolder& folder, int count) {
  const auto now = fs::file_time_type::clock::now();
  for (int i = 0; i < count; ++i) {
    folder.write(nameOf(i), bytesFor(1000));
    fs::last_write_time(folder.at(nameOf(i)), now - std::chrono::minutes(count + 10 - i));
  }
}

}  // namespace

TEST_CASE("the binaries used longest ago go first, down to seven eighths of the limit") {
  TemporaryFolder folder;
  fill(folder, 20);
  touch(folder.at(nameOf(0)));
  CHECK(pruneBinaries(folder.path().string(), 20000) == 0);
  CHECK(pruneBinaries(folder.path().string(), 16000) == 6);
  CHECK(bytesIn(folder.path().string()) == 14000);
  CHECK(fs::exists(folder.at(nameOf(0))));
  for (int i = 1; i <= 6; ++i) CHECK_FALSE(fs::exists(folder.at(nameOf(i))));
  for (int i = 7; i < 20; ++i) CHECK(fs::exists(folder.at(nameOf(i))));
}

TEST_CASE("files of others are never removed") {
  TemporaryFolder folder;
  fill(folder, 4);
  const std::string other = bytesFor(100000);
  folder.write("notes.bin", other);
  folder.write(nameOf(4) + ".txt", other);
  folder.write("kept", bytesFor(100000));
  fs::create_symlink(folder.at("kept"), folder.at(nameOf(6)));
  fs::create_directory(folder.at(nameOf(7)));
  CHECK(pruneBinaries(folder.path().string(), 100) == 4);
  for (const std::string& name :
       {std::string("notes.bin"), nameOf(4) + ".txt", nameOf(6), nameOf(7), std::string("kept")})
    CHECK_MESSAGE(fs::exists(folder.at(name)), name);
  CHECK(pruneBinaries(folder.at("nowhere"), 100) == 0);
}

TEST_CASE("several processes write and remove at once") {
  TemporaryFolder folder;
  fill(folder, 100);
  std::vector<pid_t> processes;
  for (int p = 1; p <= 4; ++p) {
    const pid_t pid = ::fork();
    REQUIRE(pid >= 0);
    if (pid == 0) {
      for (int i = 0; i < 50; ++i) {
        const std::string path = folder.at(nameOf(1000 * p + i));
        {
          std::ofstream file(path + ".tmp", std::ios::binary);
          file << bytesFor(1000);
        }
        std::error_code ec;
        fs::rename(path + ".tmp", path, ec);
        touch(folder.at(nameOf(i)));
        pruneBinaries(folder.path().string(), 20000);
        if (ec) ::_exit(1);
      }
      ::_exit(0);
    }
    processes.push_back(pid);
  }
  for (const pid_t pid : processes) {
    int status = -1;
    CHECK(::waitpid(pid, &status, 0) == pid);
    CHECK(status == 0);
  }
  CHECK(bytesIn(folder.path().string()) <= 24000);  // each process may have written one more
  pruneBinaries(folder.path().string(), 20000);
  CHECK(bytesIn(folder.path().string()) <= 20000);
}
