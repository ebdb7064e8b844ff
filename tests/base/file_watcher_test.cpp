#include "engine/base/file_watcher.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace fs = std::filesystem;
using weft::base::FileWatcher;
using Names = std::vector<std::string>;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / ("weft_watch_" + std::to_string(::getpid()));
  Folder() { fs::remove_all(path), fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  std::string operator/(const char* name) const { return (path / name).string(); }
};

void write(const std::string& path, const char* text = "text") { std::ofstream(path) << text; }

}  // namespace

TEST_CASE("a write and a replacement by rename are seen once, neighbours are not") {
  const Folder folder;
  const std::string a = folder / "a.json", b = folder / "b.glsl";
  write(a), write(b);
  FileWatcher watcher;
  REQUIRE(watcher.works());
  watcher.watch({a, b});
  CHECK(watcher.poll().empty());
  write(a);
  CHECK(watcher.poll() == Names{a});
  CHECK(watcher.poll().empty());
  write(folder / "a.json.tmp");
  CHECK(watcher.poll().empty());
  for (int i = 0; i < 3; ++i) {
    write(folder / "b.glsl~");
    fs::rename(folder / "b.glsl~", b);
    CHECK(watcher.poll() == Names{b});
  }
  fs::remove(a);
  CHECK(watcher.poll() == Names{a});
  fs::rename(b, folder / "c.glsl");
  CHECK(watcher.poll() == Names{b});
  write(a), write(b);
  CHECK(watcher.poll() == Names{a, b});
}

TEST_CASE("files and folders that do not exist yet") {
  const Folder folder;
  const std::string direct = folder / "late.json", deep = folder / "x/y/late.glsl";
  FileWatcher watcher;
  watcher.watch({direct, deep});
  CHECK(watcher.poll().empty());
  write(direct);
  CHECK(watcher.poll() == Names{direct});
  fs::create_directories(folder.path / "x" / "y");
  CHECK(watcher.poll().empty());
  write(deep);
  CHECK(watcher.poll() == Names{deep});

  SUBCASE("a folder replaced as a whole") {
    fs::create_directories(folder.path / "new");
    write(folder / "new/late.glsl");
    fs::rename(folder.path / "x" / "y", folder.path / "old");
    watcher.poll();
    fs::rename(folder.path / "new", folder.path / "x" / "y");
    CHECK(watcher.poll() == Names{deep});
    write(deep);
    CHECK(watcher.poll() == Names{deep});
  }
  SUBCASE("a folder made together with its file") {
    fs::remove_all(folder.path / "x");
    watcher.poll();
    fs::create_directories(folder.path / "x" / "y");
    write(deep);
    CHECK(watcher.poll() == Names{deep});
  }
}

TEST_CASE("names stay as given, links are followed, another set takes over") {
  const Folder folder;
  fs::create_directories(folder.path / "real");
  const std::string real = folder / "real/a.json", link = folder / "a.json", other = folder / "other.json";
  write(real), write(other);
  fs::create_symlink(real, link);
  const std::string odd = folder / "real/../other.json";
  FileWatcher watcher;
  watcher.watch({link, odd});
  write(real);
  CHECK(watcher.poll() == Names{link});
  write(other);
  CHECK(watcher.poll() == Names{odd});
  write(other);
  watcher.watch({odd, real});
  CHECK(watcher.poll() == Names{odd});
  write(real);
  CHECK(watcher.poll() == Names{real});
  watcher.watch({odd});
  write(real);
  CHECK(watcher.poll().empty());
}
