#include "engine/base/files/file_kind.h"

#include <algorithm>

namespace weft::base {

namespace {

using std::string_view_literals::operator""sv;

struct Signature {
  std::string_view bytes;
  FileKind kind;
};

constexpr std::string_view kPicture =
    "name a graph, which is JSON; 'weft types' lists the imports by which a graph takes pictures";
constexpr std::string_view kEnvironment =
    "the option --environment takes it: weft check GRAPH --environment FILE";
constexpr std::string_view kModel = "the option --scene takes it: weft check GRAPH --scene FILE";
constexpr std::string_view kPacked = "unpack it, and name a file of it";
constexpr std::string_view kOther = "name a JSON file";
constexpr std::string_view kEncoding = "save the file as UTF-8";

constexpr Signature kSignatures[] = {
    {"\x89PNG\r\n\x1a\n"sv, {"a PNG picture", kPicture}},
    {"\xff\xd8\xff"sv, {"a JPEG picture", kPicture}},
    {"GIF8"sv, {"a GIF picture", kPicture}},
    {"II*\0"sv, {"a TIFF picture", kPicture}},
    {"MM\0*"sv, {"a TIFF picture", kPicture}},
    {"DDS "sv, {"a DDS texture", kPicture}},
    {"\xabKTX "sv, {"a KTX texture", kPicture}},
    {"\x76\x2f\x31\x01"sv, {"an OpenEXR picture", kEnvironment}},
    {"#?RADIANCE"sv, {"a Radiance HDR picture", kEnvironment}},
    {"#?RGBE"sv, {"a Radiance HDR picture", kEnvironment}},
    {"glTF"sv, {"a binary glTF model", kModel}},
    {"Kaydara FBX Binary"sv, {"an FBX model", kModel}},
    {"BLENDER"sv, {"a Blender file", "export it as .glb, which the option --scene takes"}},
    {"PK\x03\x04"sv, {"a ZIP archive", kPacked}},
    {"\x1f\x8b"sv, {"a gzip file", kPacked}},
    {"\x28\xb5\x2f\xfd"sv, {"a Zstandard file", kPacked}},
    {"\xfd"
     "7zXZ"sv,
     {"an xz file", kPacked}},
    {"%PDF"sv, {"a PDF document", kOther}},
    {"\x7f"
     "ELF"sv,
     {"a program", kOther}},
    {"\xff\xfe"sv, {"UTF-16 text", kEncoding}},
    {"\xfe\xff"sv, {"UTF-16 text", kEncoding}},
};

}  // namespace

std::optional<FileKind> kindOfFile(std::string_view bytes) {
  for (const Signature& signature : kSignatures)
    if (bytes.starts_with(signature.bytes)) return signature.kind;
  if (bytes.starts_with("RIFF") && bytes.substr(std::min<std::size_t>(8, bytes.size())).starts_with("WEBP"))
    return FileKind{"a WebP picture", kPicture};
  return std::nullopt;
}

}  // namespace weft::base
