// Sets of frames, and manifests of what is written.
#include <doctest/doctest.h>

#include <fstream>

#include "app/output/frame_set.h"
#include "app/output/manifest.h"
#include "engine/text/files/file.h"
#include "tests/temporary_folder.h"

using namespace weft;
using namespace weft::app;

TEST_CASE("a set of frames is read sorted, each frame once, and printed as it is read") {
  using Frames = std::vector<std::uint32_t>;
  const std::pair<const char*, Frames> good[] = {{"7", {7}},
                                                 {"1:3", {1, 2, 3}},
                                                 {"1-10x3,20", {1, 4, 7, 10, 20}},
                                                 {"9,2-4,3:12x3,2", {2, 3, 4, 6, 9, 12}},
                                                 {"4294967294-4294967295", {4294967294, 4294967295}},
                                                 {"5-4294967295x4294967290", {5, 4294967295}},
                                                 {"0-9x20", {0}}};
  for (const auto& [text, wanted] : good) {
    Frames frames, again;
    CAPTURE(text);
    CHECK(takeFrames(text, frames) == "");
    CHECK(frames == wanted);
    CHECK(takeFrames(framesText(frames), again) == "");
    CHECK(again == wanted);
  }
  CHECK(framesText(Frames{1, 4, 7, 10, 20, 21, 30, 40}) == "1-10x3,20-21,30,40");
  for (const char* bad : {"", ",", "1,", "-1", "1-", "3-1", "1-9x0", "1-9x", "7x3", "1-2-3", "1-9x2x3", " 1",
                          "1.5", "a", "4294967296", "1:9:2"}) {
    Frames frames;
    CAPTURE(bad);
    CHECK(takeFrames(bad, frames).starts_with("expected FRAME, FIRST-LAST"));
  }
  Frames frames;
  CHECK(takeFrames("1-3,9-7", frames).ends_with("no FIRST above its LAST, found '9-7'"));
  CHECK(takeFrames("0-4294967295", frames).starts_with("expected at most 16777216 frames"));
}

namespace {

struct Folder : TemporaryFolder {
  Folder() {
    for (const char* name : {"f_1.png", "f_2.png"})
      REQUIRE(text::writeFile(at(name), std::string_view(name), said));
  }
  Manifest manifest(const char* settings) { return {at("m.jsonl"), settings, {{"host", "here"}}}; }
  Manifest read(const char* settings) {
    Manifest made = manifest(settings);
    CHECK_MESSAGE(made.read(said), said.text());
    return made;
  }
  bool isDone(const char* settings, std::uint32_t frame) {
    const std::string file = at("f_" + std::to_string(frame) + ".png");
    return read(settings).isDone(frame, {&file, 1});
  }
  void add(const char* settings, std::uint32_t frame) {
    const std::string file = at("f_" + std::to_string(frame) + ".png");
    CHECK(manifest(settings).add(frame, {&file, 1}, 0.5, said));
  }
  std::string text() { return text::readFile(at("m.jsonl"), said).value_or(""); }
  text::Diagnostics said;
};

}  // namespace

TEST_CASE("a frame is done when its file has the bytes that were written under the same settings") {
  Folder folder;
  CHECK_FALSE(folder.isDone("a", 1));  // there is no manifest
  folder.add("a", 1);
  CHECK(folder.isDone("a", 1));
  CHECK_FALSE(folder.isDone("a", 2));
  CHECK_FALSE(folder.isDone("b", 1));
  CHECK(folder.read("b").hasOther(1));
  CHECK_FALSE(folder.read("a").hasOther(1));
  const std::string files[] = {folder.at("f_1.png"), folder.at("f_2.png")};
  CHECK_FALSE(folder.read("a").isDone(1, files));  // of which only one was written
  std::ofstream(folder.at("f_1.png"), std::ios::app) << "x";
  CHECK_FALSE(folder.isDone("a", 1));
  std::filesystem::remove(folder.at("f_1.png"));
  CHECK_FALSE(folder.isDone("a", 1));
  std::filesystem::create_directory(folder.at("f_1.png"));
  CHECK_FALSE(folder.isDone("a", 1));
}

TEST_CASE("a line that was torn is passed over, and the next one stands in a line of its own") {
  Folder folder;
  folder.add("a", 1);
  const std::string line = folder.text();
  for (const std::string& torn : {line.substr(0, 1), line.substr(0, 12), line.substr(0, line.size() - 2)}) {
    std::ofstream(folder.at("m.jsonl"), std::ios::binary) << torn;
    CHECK_FALSE(folder.isDone("a", 1));
    folder.add("a", 2);
    CHECK(folder.text() == torn + "\n" + folder.text().substr(torn.size() + 1));
    CHECK(folder.isDone("a", 2));
  }
  CHECK(folder.said.empty());
}

TEST_CASE("a file that is no manifest is refused at its line; a line that is damaged is told and left out") {
  for (const char* bad :
       {"no JSON\n", "{}\n", "[1]\n", "7\n", "{\"frame\":-1,\"files\":{},\"settings\":\"\"}\n",
        "{\"frame\":4294967297,\"files\":{},\"settings\":\"\"}\n",
        "{\"frame\":1,\"files\":[],\"settings\":\"\"}\n", "{ \"name\": \"a graph\" }\n"}) {
    for (const bool manifest : {false, true}) {
      Folder folder;
      if (manifest) folder.add("a", 1);
      std::ofstream(folder.at("m.jsonl"), std::ios::app) << bad << bad;
      if (manifest) folder.add("a", 2);
      CAPTURE(folder.said.text());
      CHECK(folder.manifest("a").read(folder.said) == manifest);
      CHECK(folder.said.hasErrors() != manifest);
      REQUIRE(folder.said.size() == 1);
      CHECK(folder.said.items()[0].place.line == 1 + manifest);
      if (manifest) CHECK((folder.isDone("a", 1) && folder.isDone("a", 2)));
    }
  }
}

TEST_CASE("a manifest lies beside the files that it is of") {
  CHECK(manifestNameOf("out/f_%04d.png") == "out/f_.frames.jsonl");
  CHECK(manifestNameOf("f_%d.tail.exr") == "f_.tail.frames.jsonl");
  CHECK(manifestNameOf("out/%04d.png") == "out/frames.jsonl");
  CHECK(manifestNameOf("out/%d/f.png") == "out/f.frames.jsonl");
  CHECK(manifestNameOf("one.png") == "one.frames.jsonl");
}
