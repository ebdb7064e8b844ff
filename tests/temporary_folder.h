// A folder for one test case, removed with what is in it. Its name is nobody else's, also when several test programs run at once.
#pragma once

#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "weft_test_XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder " + pattern);
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string at(std::string_view name) const { return (path_ / name).string(); }
  // Writes a file, makes its folders, and returns its path. The file has a time of its own, so that a rewrite within the
  // clock's grain is seen.
  std::string write(std::string_view name, std::string_view bytes) const {
    const std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    // tests/fuzz begins with what tests write: one file of each size and kind.
    if (const char* kept = std::getenv("WEFT_KEEP_FILES"))
      std::ofstream(kept + ("/" + std::to_string(bytes.size())) + file.extension().string(), std::ios::binary)
          << bytes;
    std::filesystem::last_write_time(
        file, std::filesystem::file_time_type::clock::now() + std::chrono::seconds(++writes_));
    return file.string();
  }

 private:
  mutable int writes_ = 0;
  std::filesystem::path path_;
};
