// What readFile() opens and what it refuses: pipes, sockets and devices; folders that reading is confined to.
// The links, `..` and absolute paths here are the ways out that were thought of; each is tried with and
// without a file behind it, and the answer is the same.
#include <doctest/doctest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "engine/text/files/file.h"
#include "tests/temporary_folder.h"

namespace fs = std::filesystem;
using namespace weft::text;

namespace {

struct Folder {
  TemporaryFolder temporary;
  const fs::path& path = temporary.path();
  Folder() {
    resetFileAccess();
    fs::create_directories(path / "in/below");
    fs::create_directories(path / "out");
  }
  ~Folder() { resetFileAccess(); }
  std::string operator/(const char* name) const { return (path / name).string(); }
};

void write(const std::string& path, const char* text = "text") {
  std::ofstream(path) << text;
}

// The only message of reading `path`, or its contents.
std::string read(const std::string& path) {
  Diagnostics all;
  if (const auto bytes = readFile(path, all)) return "read: " + *bytes;
  REQUIRE(all.size() == 1);
  return format(all.items()[0]);
}

bool isRefusedOutside(const std::string& path) {
  return read(path).find("error[W200]: '" + path + "' leads out of") != std::string::npos;
}

}  // namespace

TEST_CASE("a pipe and a socket are refused at once, and say what they are") {
  const Folder folder;
  const std::string pipe = folder / "pipe", path = folder / "socket";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  CHECK(
      read(pipe).find("it is a pipe\n    fix: name a file; only a path on the command line may be a pipe") !=
      std::string::npos);
  fs::create_symlink(pipe, folder / "link");
  CHECK(read(folder / "link").find("it is a pipe") != std::string::npos);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  REQUIRE(path.size() < sizeof address.sun_path);
  path.copy(address.sun_path, path.size());
  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  REQUIRE(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
  CHECK(read(path).find("it is a socket") != std::string::npos);
  ::close(socket);
}

TEST_CASE("a path of the command line may be a pipe, which is read once and kept") {
  const Folder folder;
  const std::string pipe = folder / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  chooseFile(pipe);
  std::thread writer([&] { write(pipe, "generated"); });
  CHECK(read(folder / "in/../pipe") == "read: generated");  // however it is spelled
  writer.join();
  CHECK(read(pipe) == "read: generated");
}

TEST_CASE(
    "a file that became a pipe after it was read is refused, also when it was named on the command line") {
  const Folder folder;
  const std::string path = folder / "graph.json";
  write(path);
  chooseFile(path);
  CHECK(read(path) == "read: text");
  fs::remove(path);
  REQUIRE(::mkfifo(path.c_str(), 0600) == 0);
  CHECK(read(path).find("it is a pipe") != std::string::npos);
}

TEST_CASE("who waits for a pipe that nobody writes to can give up") {
  const Folder folder;
  const std::string pipe = folder / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  chooseFile(pipe);
  Diagnostics all;
  std::stop_source impatient;
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    impatient.request_stop();
  });
  CHECK_FALSE(readFile(pipe, all, Code::unreadableFile, {}, impatient.get_token()));
  later.join();
  CHECK(all.empty());
}

TEST_CASE("paths are free until a folder is confined") {
  const Folder folder;
  write(folder / "out/a.json");
  fs::create_symlink(folder.path / "out/a.json", folder / "in/link");
  CHECK(read(folder / "in/link") == "read: text");
  CHECK(read(folder / "in/../out/a.json") == "read: text");
  CHECK(mayRead("/etc/passwd"));
}

TEST_CASE("confined, no path leads out, whether or not a file is there") {
  const Folder folder;
  write(folder / "in/a.json");
  write(folder / "in/below/b.json");
  write(folder / "out/there");
  write(folder / "inner");  // begins as the folder does
  fs::create_directories(folder.path / "inside");
  write(folder / "inside/there");
  fs::create_symlink(folder.path / "out", folder / "in/absolute");
  fs::create_symlink("../out", folder / "in/relative");
  fs::create_symlink("../out/there", folder / "in/to_there");
  fs::create_symlink("../out/not_there", folder / "in/to_not_there");
  fs::create_symlink("relative/there", folder / "in/chain");
  fs::create_symlink("/", folder / "in/root");
  fs::create_symlink("..", folder / "in/up");
  fs::create_symlink("below/b.json", folder / "in/good");
  fs::create_symlink(folder.path / "in/below", folder / "in/good_folder");
  fs::create_symlink("loop", folder / "in/loop");
  REQUIRE_FALSE(confineTo(folder / "in"));

  CHECK(read(folder / "in/a.json") == "read: text");
  CHECK(read(folder / "in/../in/below/../a.json") == "read: text");
  CHECK(read(folder / "in/good") == "read: text");
  CHECK(read(folder / "in/good_folder/b.json") == "read: text");
  CHECK(read(folder / "in/up/in/a.json") == "read: text");

  for (const char* path :
       {"out/there", "out/not_there", "in/../out/there", "in/../out/not_there", "in/absolute/there",
        "in/absolute/not_there", "in/relative/there", "in/relative/not_there", "in/to_there",
        "in/to_not_there", "in/chain", "in/root/etc/passwd", "in/root/no/such", "in/up/out/there",
        "in/up/out/not_there", "in/up", "inner", "inside/there", "inside/not_there"}) {
    CAPTURE(path);
    CHECK(isRefusedOutside(folder / path));
    CHECK_FALSE(mayRead(folder / path));
  }
  for (const char* path :
       {"/etc/passwd", "/etc/no_such_file", "/", "/proc/self/root/etc/passwd", "/dev/stdin"}) {
    CAPTURE(path);
    CHECK(isRefusedOutside(path));
  }
  // Inside, what is missing is missing.
  CHECK(read(folder / "in/a.jsn")
            .find("no such file\n    fix: did you mean '" + (folder / "in/a.json") + "'?") !=
        std::string::npos);
  CHECK(read(folder / "in/below").find("it is a directory") != std::string::npos);
  CHECK(read(folder / "in/loop").find("Too many levels of symbolic links") != std::string::npos);
  REQUIRE(::mkfifo((folder / "in/pipe").c_str(), 0600) == 0);
  CHECK(read(folder / "in/pipe").find("it is a pipe") != std::string::npos);
}

TEST_CASE("confined: the message names the folders and the place, and more folders may be named") {
  const Folder folder;
  write(folder / "out/there");
  REQUIRE_FALSE(confineTo(folder / "in"));
  Diagnostics all;
  CHECK_FALSE(readFile(folder / "out/there", all, Code::unreadableImage, {"graph.json", 3, 7}));
  REQUIRE(all.size() == 1);
  const Diagnostic& d = all.items()[0];
  CHECK(d.code == Code::outsideConfinement);
  CHECK(*d.place.file == "graph.json");
  CHECK(d.place.line == 3);
  CHECK(d.expected.find("'" + (folder / "in") + "'") != std::string::npos);
  CHECK(d.hint.find("--confine") != std::string::npos);
  REQUIRE_FALSE(confineTo(folder / "out"));
  CHECK(read(folder / "out/there") == "read: text");
  CHECK(confineTo(folder / "no_such").value_or("").find("which is none") != std::string::npos);
}

TEST_CASE("confined: what the command line names is free, and what lies beside it is not") {
  const Folder folder;
  write(folder / "out/graph.json");
  write(folder / "out/beside.json");
  fs::create_directories(folder.path / "maps");
  write(folder / "maps/a.hdr");
  fs::create_symlink(folder.path / "out/beside.json", folder / "maps/link.hdr");
  REQUIRE_FALSE(confineTo(folder / "in"));
  chooseFile(folder / "out/graph.json");
  chooseFile(folder / "maps");
  allowFolder(folder / "later");
  CHECK(read(folder / "out/graph.json") == "read: text");
  CHECK(isRefusedOutside(folder / "out/beside.json"));
  CHECK(read(folder / "maps/a.hdr") == "read: text");
  CHECK(isRefusedOutside(folder / "maps/link.hdr"));
  fs::create_directories(folder.path / "later");
  write(folder / "later/a.bin");
  CHECK(read(folder / "later/a.bin") == "read: text");
}

TEST_CASE("confined: a folder spelled by a link is the folder it leads to") {
  const Folder folder;
  write(folder / "in/a.json");
  write(folder / "in/b.json");
  fs::create_symlink(folder.path / "in", folder / "spelled");
  fs::create_symlink(folder.path / "in", folder / "too");
  REQUIRE_FALSE(confineTo(folder / "spelled"));
  chooseFile(folder / "too/a.json");
  CHECK(read(folder / "in/a.json") == "read: text");
  CHECK(read(folder / "spelled/a.json") == "read: text");
  CHECK(read(folder / "too/b.json") == "read: text");  // beside the graph, as its includes are
}
