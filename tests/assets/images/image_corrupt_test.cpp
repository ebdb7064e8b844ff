// Files that are wrong in every way a file can be: each gives a diagnostic, none crashes (the sanitizers
// watch).
#include <doctest/doctest.h>
#include <stb/stb_image_write.h>

#include <cstdlib>
#include <filesystem>
#include <random>

#include "engine/assets/images/image.h"
#include "engine/text/files/file.h"
#include "engine/text/limits.h"
#include "tests/assets/images/save_hdr.h"
#include "tests/load_image.h"
#include "tests/temporary_folder.h"

using namespace weft;
using namespace weft::assets;

namespace {

// The one error of a load that must fail.
text::Diagnostic imageFailure(const std::string& path) {
  text::Diagnostics diagnostics;
  CHECK_FALSE(loadImage(path, diagnostics));
  REQUIRE_MESSAGE(diagnostics.errorCount() == 1, path << "\n" << diagnostics.text());
  CHECK(diagnostics.items()[0].message.find(path) != std::string::npos);
  return diagnostics.items()[0];
}

std::string bytesOf(const std::string& path) {
  text::Diagnostics diagnostics;
  return text::readFile(path, diagnostics).value();
}

// A valid file of each kind: name and bytes.
struct Sample {
  std::string name, bytes;
};

std::string tga(int width, int height, bool runLength) {
  std::string bytes(18, '\0');
  bytes[2] = runLength ? 10 : 2;
  bytes[12] = static_cast<char>(width);
  bytes[14] = static_cast<char>(height);
  bytes[16] = 24;
  for (int y = 0; y < height; ++y) {
    if (runLength) {
      bytes += static_cast<char>(128 + width - 1);
      bytes += "abc";
    } else {
      for (int x = 0; x < width; ++x) bytes += "xyz";
    }
  }
  return bytes;
}

std::vector<Sample> makeSamples(const TemporaryFolder& folder) {
  text::Diagnostics diagnostics;
  std::mt19937 random(3);
  ImageF image{40, 24, 3, {}};
  std::vector<std::uint8_t> bytes;
  for (int i = 0; i < 40 * 24 * 3; ++i) {
    image.texels.push_back(static_cast<float>(random() % 1000) / 37.0f);
    bytes.push_back(static_cast<std::uint8_t>(random()));
  }
  ImageF narrow{5, 4, 3, std::vector<float>(60, 0.5f)};
  REQUIRE(saveHdr(folder.at("wide.hdr"), image, diagnostics));
  REQUIRE(saveHdr(folder.at("narrow.hdr"), narrow, diagnostics));
  REQUIRE(saveExr(folder.at("a.exr"), image, diagnostics));
  REQUIRE(savePng8(folder.at("a.png"), 40, 24, 3, bytes, diagnostics));
  std::string jpeg;
  stbi_write_jpg_to_func(
      [](void* out, void* data, int count) {
        static_cast<std::string*>(out)->append(static_cast<char*>(data), static_cast<std::size_t>(count));
      },
      &jpeg, 40, 24, 3, bytes.data(), 90);
  folder.write("a.jpg", jpeg);
  folder.write("flat.tga", tga(40, 24, false));
  folder.write("runs.tga", tga(40, 24, true));
  std::vector<Sample> samples;
  for (const char* name : {"wide.hdr", "narrow.hdr", "a.exr", "a.png", "a.jpg", "flat.tga", "runs.tga"})
    samples.push_back({name, bytesOf(folder.at(name))});
  return samples;
}

}  // namespace

TEST_CASE("missing, directory, empty, unknown and foreign files") {
  const TemporaryFolder folder;
  CHECK(imageFailure(folder.at("missing.hdr")).code == text::Code::unreadableImage);
  std::filesystem::create_directory(folder.at("folder.hdr"));
  CHECK(imageFailure(folder.at("folder.hdr")).message.find("directory") != std::string::npos);
  for (const char* name : {"empty.hdr", "empty.exr", "empty.png", "empty.jpg", "empty.webp", "empty.tga"})
    CHECK(imageFailure(folder.write(name, "")).message.find("empty") != std::string::npos);
  const text::Diagnostic unknown = imageFailure(folder.write("a.gif", "GIF89a"));
  CHECK(unknown.code == text::Code::unknownImageKind);
  CHECK(unknown.found == ".gif");
  CHECK(imageFailure(folder.write("noextension", "x")).code == text::Code::unknownImageKind);
  for (const char* name : {"text.hdr", "text.exr", "text.png", "text.jpg", "text.webp", "text.tga"})
    CHECK(imageFailure(folder.write(name, "this is a text, and not a picture at all")).code ==
          text::Code::unreadableImage);
  CHECK(imageFailure(folder.write("radiance.png", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\nabcd"))
            .message.find("Radiance") != std::string::npos);
}

TEST_CASE("an 8-bit load of a float file says what it takes") {
  const TemporaryFolder folder;
  text::Diagnostics diagnostics;
  CHECK_FALSE(loadImage8(folder.write("a.exr", "x"), 3, diagnostics));
  CHECK(diagnostics.contains(text::Code::unknownImageKind));
}

TEST_CASE("the samples are sound, and each cut anywhere is refused") {
  const TemporaryFolder folder;
  for (const Sample& sample : makeSamples(folder)) {
    text::Diagnostics diagnostics;
    CHECK_MESSAGE(decodeImage(sample.bytes, sample.name, diagnostics), diagnostics.text());
    for (std::size_t cut = 1; cut <= 60; ++cut) {
      const std::size_t length = sample.bytes.size() * cut / 61;
      // The end of a PNG is a marker behind the texels, of an EXR its last block.
      diagnostics.clear();
      const auto image =
          decodeImage(std::string_view(sample.bytes).substr(0, length), sample.name, diagnostics);
      CHECK_MESSAGE(!image, sample.name << " cut to " << length << " of " << sample.bytes.size());
      CHECK(diagnostics.errorCount() == 1);
    }
  }
}

TEST_CASE("absurd sizes in a header are refused before anything is allocated") {
  const TemporaryFolder folder;
  const auto hdr = [](const char* size) {
    return std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n") + size + "\nabcd";
  };
  CHECK(imageFailure(folder.write("a.hdr", hdr("-Y 1000000000 +X 1000000000"))).code ==
        text::Code::badImageSize);
  CHECK(imageFailure(folder.write("b.hdr", hdr("-Y 30000 +X 30000"))).code == text::Code::badImageSize);
  CHECK(imageFailure(folder.write("c.hdr", hdr("-Y 0 +X 10"))).code == text::Code::badImageSize);
  // What a texture holds of it counts: 4, 8 or 16 bytes a texel. --limit raises it.
  CHECK(imageFailure(folder.write("d.hdr", hdr("-Y 4096 +X 8192"))).code == text::Code::unreadableImage);
  const std::string more = folder.write("m.hdr", hdr("-Y 4097 +X 8192"));
  CHECK(imageFailure(more).code == text::Code::badImageSize);
  CHECK(imageFailure(more).hint == "raise the limits with --limit 2, if that is meant");
  text::limitsRaised = 2;
  CHECK(imageFailure(more).code == text::Code::unreadableImage);
  text::limitsRaised = 1;
  for (const char depth : {8, 16}) {
    using namespace std::string_literals;
    const std::string png = "\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\x40\0\0\0\x20\0"s + depth +
                            "\x02\0\0\0\0\0\0\0\0\0\0\0IDAT\0\0\0\0"s;
    text::Diagnostics header, floats;
    CHECK(loadHeader(folder.write("p.png", png), header).has_value() == (depth == 8));
    CHECK(header.contains(text::Code::badImageSize) == (depth == 16));
    CHECK_FALSE(decodeImage(png, "p.png", floats));
    CHECK(floats.contains(text::Code::badImageSize));
  }
  CHECK(imageFailure(folder.write("e.hdr", hdr("+X 4 -Y 4"))).code == text::Code::unreadableImage);
  CHECK(imageFailure(folder.write("f.hdr", hdr("-Y -4 +X -4"))).code == text::Code::unreadableImage);
  CHECK(imageFailure(folder.write("g.hdr", hdr("+X 4 -X 4"))).code == text::Code::unreadableImage);
}

TEST_CASE(
    "a JPEG whose Huffman table has more than 256 codes is refused before it is decoded, also with fill "
    "bytes in front") {
  const TemporaryFolder folder;
  for (const Sample& sample : makeSamples(folder)) {
    if (sample.name != "a.jpg") continue;
    std::string bytes = sample.bytes;
    const std::size_t table = bytes.find("\xff\xc4");
    REQUIRE(table != std::string::npos);
    bytes[table + 5 + 10] = '\xff';
    bytes[table + 5 + 11] = '\xff';
    text::Diagnostics diagnostics;
    CHECK_FALSE(decodeImage(bytes, "a.jpg", diagnostics));
    CHECK_FALSE(decodeImage("\xff" + bytes, "a.jpg", diagnostics));
    REQUIRE(diagnostics.errorCount() == 2);
    for (const text::Diagnostic& d : diagnostics.items())
      CHECK(d.message.find("Huffman") != std::string::npos);
    diagnostics.clear();
    CHECK(decodeImage("\xff" + sample.bytes, "a.jpg", diagnostics));
  }
}

TEST_CASE("ten thousand files with random bytes changed: an image or an error, and no crash") {
  const TemporaryFolder folder;
  const char* seed = std::getenv("WEFT_FUZZ_SEED");
  std::mt19937 random(seed ? static_cast<std::uint32_t>(std::atoi(seed)) : 5u);
  int images = 0, errors = 0;
  for (const Sample& sample : makeSamples(folder)) {
    for (int i = 0; i < 10000 / 7; ++i) {
      std::string bytes = sample.bytes;
      const std::size_t changes = 1 + random() % 8;
      for (std::size_t k = 0; k < changes; ++k) {
        // Half of the changes hit the header.
        const std::size_t range = random() % 2 ? bytes.size() : std::min<std::size_t>(bytes.size(), 400);
        bytes[random() % range] = static_cast<char>(random());
      }
      if (random() % 4 == 0) bytes.resize(random() % bytes.size());
      text::Diagnostics diagnostics;
      const auto image = decodeImage(bytes, sample.name, diagnostics);
      REQUIRE(image.has_value() == !diagnostics.hasErrors());
      if (image) {
        REQUIRE(image->texels.size() == static_cast<std::size_t>(image->width) *
                                            static_cast<std::size_t>(image->height) *
                                            static_cast<std::size_t>(image->channels));
        ++images;
      } else {
        ++errors;
      }
    }
  }
  MESSAGE(images << " images, " << errors << " refused");
  CHECK(images > 0);
  CHECK(errors > 0);
}
