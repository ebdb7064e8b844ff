#include "engine/text/files/file_watcher.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/temporary_folder.h"

namespace fs = std::filesystem;
using weft::text::FileWatcher;
using Names = std::vector<std::string>;

namespace {

struct WatchedFolder {
  TemporaryFolder temporary;
  const fs::path& path = temporary.path();
  std::string operator/(const char* name) const { return (path / name).string(); }
};

void save(const std::string& path, const char* text = "text") {
  std::ofstream(path) << text;
}

}  // namespace

TEST_CASE("a write and a replacement by rename are seen once, neighbors are not") {
  const WatchedFolder folder;
  const std::string a = folder / "a.json", b = folder / "b.glsl";
  save(a), save(b);
  FileWatcher watcher;
  REQUIRE(watcher.descriptor() >= 0);
  watcher.watch({a, b});
  CHECK(watcher.poll().empty());
  save(a);
  CHECK(watcher.poll() == Names{a});
  CHECK(watcher.poll().empty());
  save(folder / "a.json.tmp");
  CHECK(watcher.poll().empty());
  for (int i = 0; i < 3; ++i) {
    save(folder / "b.glsl~");
    fs::rename(folder / "b.glsl~", b);
    CHECK(watcher.poll() == Names{b});
  }
  fs::remove(a);
  CHECK(watcher.poll() == Names{a});
  fs::rename(b, folder / "c.glsl");
  CHECK(watcher.poll() == Names{b});
  save(a), save(b);
  CHECK(watcher.poll() == Names{a, b});
}

TEST_CASE("files and folders that do not exist yet") {
  const WatchedFolder folder;
  const std::string direct = folder / "late.json", deep = folder / "x/y/late.glsl";
  FileWatcher watcher;
  watcher.watch({direct, deep});
  CHECK(watcher.poll().empty());
  save(direct);
  CHECK(watcher.poll() == Names{direct});
  fs::create_directories(folder.path / "x" / "y");
  CHECK(watcher.poll().empty());
  save(deep);
  CHECK(watcher.poll() == Names{deep});

  SUBCASE("a folder replaced as a whole") {
    fs::create_directories(folder.path / "new");
    save(folder / "new/late.glsl");
    fs::rename(folder.path / "x" / "y", folder.path / "old");
    watcher.poll();
    fs::rename(folder.path / "new", folder.path / "x" / "y");
    CHECK(watcher.poll() == Names{deep});
    save(deep);
    CHECK(watcher.poll() == Names{deep});
  }
  SUBCASE("a folder made together with its file") {
    fs::remove_all(folder.path / "x");
    watcher.poll();
    fs::create_directories(folder.path / "x" / "y");
    save(deep);
    CHECK(watcher.poll() == Names{deep});
  }
}

TEST_CASE("names stay as given, links are followed, another set takes over") {
  const WatchedFolder folder;
  fs::create_directories(folder.path / "real");
  const std::string real = folder / "real/a.json", link = folder / "a.json", other = folder / "other.json";
  save(real), save(other);
  fs::create_symlink(real, link);
  const std::string odd = folder / "real/../other.json";
  FileWatcher watcher;
  watcher.watch({link, odd});
  save(real);
  CHECK(watcher.poll() == Names{link});
  save(other);
  CHECK(watcher.poll() == Names{odd});
  save(other);
  watcher.watch({odd, real});
  CHECK(watcher.poll() == Names{odd});
  save(real);
  CHECK(watcher.poll() == Names{real});
  watcher.watch({odd});
  save(real);
  CHECK(watcher.poll().empty());
}

TEST_CASE("what is not watched is said once") {
  const WatchedFolder folder;
  const std::string a = folder / "a.json", late = folder / "x/late.glsl";
  rlimit before{};
  REQUIRE(::getrlimit(RLIMIT_NOFILE, &before) == 0);
  const int next = ::open("/dev/null", O_RDONLY);  // the lowest that is free
  REQUIRE(next >= 0);
  ::close(next);
  const rlimit none{static_cast<rlim_t>(next), before.rlim_max};
  REQUIRE(::setrlimit(RLIMIT_NOFILE, &none) == 0);
  FileWatcher watcher;
  REQUIRE(::setrlimit(RLIMIT_NOFILE, &before) == 0);
  REQUIRE(watcher.descriptor() < 0);
  watcher.watch({a, late});
  save(a);
  CHECK(watcher.poll().empty());
  const auto said = watcher.takeNotices();
  REQUIRE(said.size() == 1);
  CHECK(said.items()[0].code == weft::text::Code::filesNotWatched);
  CHECK(said.items()[0].severity == weft::text::Severity::note);
  CHECK(said.items()[0].found == "inotify: Too many open files");
  watcher.watch({a});
  CHECK(watcher.takeNotices().empty());
}
