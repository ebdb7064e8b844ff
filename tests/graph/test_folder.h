// A folder of files for the time of a test.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace weft::graph::test {

class TestFolder {
 public:
  // Empty, with an empty folder `parts` in it. `name` is one test file's own.
  explicit TestFolder(const std::string& name) : path_(std::filesystem::path(WEFT_BINARY_DIR) / name) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_ / "parts");
  }
  ~TestFolder() { std::filesystem::remove_all(path_); }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  std::string file(const std::string& name) const { return (path_ / name).string(); }
  // The path of the file; `name` may lead into folders, which are made.
  std::string write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << text;
    return file(name);
  }

 private:
  std::filesystem::path path_;
};

}  // namespace weft::graph::test
