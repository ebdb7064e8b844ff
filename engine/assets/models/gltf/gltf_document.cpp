#include "engine/assets/models/gltf/gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <type_traits>

#include "assets_sentences.h"
#include "engine/text/limits.h"

namespace weft::assets {

using text::Code;
using text::JsonValue;

namespace {

constexpr std::uint64_t kMaxBytes = 1ull << 40;  // no file is so large; sums of these do not overflow

// What a file may ask for that Weft does, or that changes no picture; each with a space before it and a comma behind it.
constexpr std::string_view kKnownExtensions =
    " EXT_mesh_gpu_instancing, EXT_meshopt_compression, EXT_texture_webp, KHR_draco_mesh_compression, "
    "KHR_lights_punctual, KHR_materials_anisotropy, KHR_materials_clearcoat, "
    "KHR_materials_emissive_strength, KHR_materials_ior, KHR_materials_iridescence, "
    "KHR_materials_pbrSpecularGlossiness, KHR_materials_sheen, KHR_materials_specular, "
    "KHR_materials_transmission, KHR_materials_unlit, KHR_materials_volume, KHR_mesh_quantization, "
    "KHR_node_visibility, KHR_texture_transform, KHR_xmp, KHR_xmp_json_ld, WEFT_blinn_phong,";
constexpr std::string_view kShownExtensions = kKnownExtensions.substr(1, kKnownExtensions.size() - 2);

bool isKnown(std::string_view extension) {
  return kKnownExtensions.find(fmt::format(" {},", extension)) != kKnownExtensions.npos;
}

// Of what type values are under keys where one of another type would be as good as none; of these, arrays of objects.
using Type = JsonValue::Type;
constexpr std::pair<std::string_view, Type> kTypes[] = {
    {"alphaMode", Type::string},     {"attributes", Type::object},
    {"children", Type::array},       {"doubleSided", Type::boolean},
    {"extensions", Type::object},    {"extensionsRequired", Type::array},
    {"interpolation", Type::string}, {"nodes", Type::array},
    {"normalized", Type::boolean},   {"pbrMetallicRoughness", Type::object},
    {"spot", Type::object},          {"visible", Type::boolean},
    {"weights", Type::array},        {"animations", Type::array},
    {"channels", Type::array},       {"materials", Type::array},
    {"primitives", Type::array},     {"scenes", Type::array},
    {"targets", Type::array}};
constexpr std::string_view kTables[] = {"animations", "channels", "materials",
                                        "primitives", "scenes",   "targets"};

using Uses = std::map<std::string, std::pair<const JsonValue*, std::size_t>>;

// Fails for a value below this one that is of another type than glTF has. `out`: the extensions that Weft does not know, where
// each is first, and how often. `extensions`: its members are extensions.
void checkValues(GltfDocument& document, const JsonValue& value, bool extensions, Uses& out) {
  for (const text::JsonMember& member : value.members) {
    const auto check = [&](const JsonValue& each, Type type) {
      if (!each.is(type)) document.fail(say::otherType, each, member.key, nameOf(type), describe(each));
    };
    if (extensions && !isKnown(member.key)) {
      ++out.try_emplace(member.key, &member.value, std::size_t{0}).first->second.second;
      continue;
    }
    if (extensions) check(member.value, Type::object);
    for (const auto& [key, type] : kTypes)
      if (key == member.key) check(member.value, type);
    for (const JsonValue& item : member.value.items)
      if (std::ranges::find(kTables, member.key) != std::end(kTables)) check(item, Type::object);
    if (member.key != "extras") checkValues(document, member.value, member.key == "extensions", out);
  }
  for (const JsonValue& item : value.items) checkValues(document, item, false, out);
}

template <class T>
T load(const char* data) {
  T value;
  std::memcpy(&value, data, sizeof value);
  return value;
}

// 0 for no type.
std::size_t bytesOfType(std::uint64_t type) {
  constexpr std::size_t kBytes[] = {1, 1, 2, 2, 0, 4, 4};
  return type >= 5120 && type <= 5126 ? kBytes[type - 5120] : 0;
}

std::uint32_t componentsOf(std::string_view kind) {
  return kind == "SCALAR" ? 1 : kind == "MAT4" ? 16 : static_cast<std::uint32_t>(kind.back() - '0');
}

double componentAt(const char* data, int type, bool normalized) {
  return withComponent(type, [&]<class T>(T) {
    const auto value = static_cast<double>(load<T>(data));
    if (!normalized || sizeof(T) == 4) return value;
    return std::max(value / static_cast<double>(std::numeric_limits<T>::max()), -1.0);
  });
}

}  // namespace

const JsonValue* valueOf(const JsonValue& object, std::initializer_list<std::string_view> keys) {
  const JsonValue* value = &object;
  for (const std::string_view key : keys)
    if (value) value = value->find(key);
  return value;
}

const std::vector<JsonValue>& itemsOf(const JsonValue& object, std::string_view key) {
  static const std::vector<JsonValue> kNone;
  const JsonValue* found = object.find(key);
  return found ? found->items : kNone;
}

std::string textOf(const JsonValue& object, std::string_view key, std::string otherwise) {
  const JsonValue* value = object.find(key);
  return value && !value->text.empty() ? value->text : otherwise;
}

void GltfDocument::failFile(std::string_view why, std::string expected, std::string found) {
  diagnostics_.error(say::cannotReadModel, files_.place(), files_.path(), why, expected, found);
  throw Refused{};
}

// The JSON. "glTF", version, length; then chunks of length, kind, bytes.
std::string_view GltfDocument::split(std::string_view bytes, std::string_view& binary) {
  if (!bytes.starts_with("glTF")) return bytes;
  const auto wordAt = [&](std::size_t at) { return load<std::uint32_t>(bytes.data() + at); };
  const std::string size = fmt::format("{} bytes", bytes.size());
  if (bytes.size() < 20) failFile("the file ends in its header", "20 bytes at least", size);
  if (wordAt(4) != 2)
    failFile("it is of another version of glTF", "version 2", fmt::format("version {}", wordAt(4)));
  if (wordAt(8) > bytes.size())
    failFile("the file ends early", fmt::format("{} bytes, as its header says", wordAt(8)), size);
  std::string_view json;
  std::size_t at = 12;
  for (int chunk = 0; at + 8 <= bytes.size() && chunk < 2; ++chunk) {
    const std::size_t length = wordAt(at), kind = wordAt(at + 4), left = bytes.size() - at - 8;
    if (length > left)
      failFile(fmt::format("chunk {} reaches beyond the file", chunk), fmt::format("at most {} bytes", left),
               fmt::format("{} bytes", length));
    if (chunk == 0 && kind != 0x4e4f534a)
      failFile("its first chunk is not JSON", "a chunk 'JSON'", "another one");
    if (chunk == 0) json = bytes.substr(at + 8, length);
    if (chunk == 1 && kind == 0x004e4942) binary = bytes.substr(at + 8, length);
    at += 8 + (length + 3) / 4 * 4;
  }
  return json;
}

GltfDocument::GltfDocument(std::string bytes, ModelFiles& files)
    : files_(files), diagnostics_(files.diagnostics()) {
  std::string_view binary;
  const std::string_view json = split(bytes, binary);
  const std::size_t before = diagnostics_.errorCount();
  auto root = text::parseJson(json, files_.path(), diagnostics_);
  refuseUnless(root && diagnostics_.errorCount() == before);
  root_ = std::move(*root);
  const JsonValue* version = valueOf(root_, {"asset", "version"});
  if (!version || !version->text.starts_with("2."))
    failFile("it is no glTF 2.0 document", "\"asset\": {\"version\": \"2.0\"}",
             version ? describe(*version) : "no version");
  checkExtensions();
  for (const JsonValue& row : rows("buffers")) buffers_.push_back(readBuffer(row, binary));
}

void GltfDocument::checkExtensions() {
  for (const JsonValue& name : rows("extensionsRequired"))
    if (!isKnown(name.text)) fail(say::unknownExtension, name, name.text, kShownExtensions);
  Uses unknown;
  checkValues(*this, root_, false, unknown);
  for (const auto& [name, use] : unknown)
    leaveOut(say::extensionLeftOut, *use.first, name, kShownExtensions, use.second,
             use.second == 1 ? "" : "s");
}

std::string GltfDocument::readBuffer(const JsonValue& row, std::string_view binary) {
  const JsonValue *uri = row.find("uri"),
                  *fallback = valueOf(row, {"extensions", "EXT_meshopt_compression", "fallback"});
  if (!uri && fallback && fallback->flag) return "";  // its views are packed
  std::optional<std::string> bytes;
  if (!uri) {
    bytes = std::string(binary);
  } else if (uri->text.starts_with("data:")) {
    bytes = decodeDataUri(uri->text);
    if (!bytes) fail(say::damagedBase64, *uri);
    refuseUnless(files_.count(bytes->size(), uri->place));
  } else {
    bytes = files_.readBeside(uri->text, uri->place, Code::unreadableModel, true);
  }
  refuseUnless(bytes.has_value());
  const std::uint64_t length = whole(row, "byteLength");
  if (length > bytes->size()) fail(say::bufferTooShort, row, length, bytes->size());
  return std::move(*bytes);
}

const JsonValue& GltfDocument::need(const JsonValue& object, std::string_view key) {
  const JsonValue* found = object.find(key);
  if (!found) fail(say::missing, object, key);
  return *found;
}

std::uint32_t GltfDocument::index(std::string_view table, std::size_t count, const JsonValue& value) {
  if (value.is(JsonValue::Type::number) && value.number >= 0 && value.number < static_cast<double>(count) &&
      value.number == std::floor(value.number))
    return static_cast<std::uint32_t>(value.number);
  fail(say::noSuchRow, value, table,
       count == 0 ? fmt::format("none: the file has no '{}'", table)
                  : fmt::format("an index from 0 to {}", count - 1),
       describe(value));
}

std::uint64_t GltfDocument::whole(const JsonValue& object, std::string_view key) {
  const JsonValue* value = object.find(key);
  if (!value) return 0;
  if (!value->is(JsonValue::Type::number) || value->number < 0 ||
      value->number > static_cast<double>(kMaxBytes) || value->number != std::floor(value->number))
    fail(say::noSize, *value, key, kMaxBytes, describe(*value));
  return static_cast<std::uint64_t>(value->number);
}

float GltfDocument::number(const JsonValue& object, std::initializer_list<std::string_view> keys,
                           double otherwise, double min, double max) {
  const JsonValue* value = valueOf(object, keys);
  if (!value) return static_cast<float>(otherwise);
  if (!value->is(JsonValue::Type::number) || value->number < min || value->number > max)
    fail(say::outOfRange, *value, std::data(keys)[keys.size() - 1], min, max, describe(*value));
  return static_cast<float>(value->number);
}

bool GltfDocument::numbers(const JsonValue& object, std::string_view key, std::span<float> out) {
  const JsonValue* value = object.find(key);
  if (!value) return false;
  const auto isSound = [](const JsonValue& item) {
    return item.is(JsonValue::Type::number) && std::abs(item.number) <= 1e9;
  };
  if (value->items.size() != out.size() || !std::ranges::all_of(value->items, isSound))
    fail(say::notSoManyNumbers, *value, key, out.size(), describe(*value));
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = static_cast<float>(value->items[i].number);
  return true;
}

GltfDocument::View GltfDocument::view(const JsonValue& which) {
  const std::size_t number = index("bufferViews", which);
  const JsonValue& row = rows("bufferViews")[number];
  if (const JsonValue* packed = valueOf(row, {"extensions", "EXT_meshopt_compression"})) {
    if (!views_.contains(number)) views_[number] = unpackMeshopt(*packed);
    return {views_[number], whole(row, "byteStride")};
  }
  const std::string& buffer = buffers_[index("buffers", need(row, "buffer"))];
  const std::uint64_t offset = whole(row, "byteOffset"), length = whole(row, "byteLength");
  if (offset + length > buffer.size()) fail(say::viewBeyondBuffer, row, buffer.size(), length, offset);
  return {std::string_view(buffer).substr(offset, length), whole(row, "byteStride")};
}

GltfAccessor GltfDocument::accessor(const JsonValue& which, std::string_view kind, bool floats) {
  const std::size_t number = index("accessors", which);
  const JsonValue& row = rows("accessors")[number];
  const std::uint64_t count = whole(row, "count"), offset = whole(row, "byteOffset"),
                      type = whole(row, "componentType");
  const std::size_t bytes = bytesOfType(type);
  const bool isUnsigned = type == 5121 || type == 5123 || type == 5125;
  if (textOf(row, "type") != kind || count == 0 || bytes == 0 || !(floats ? type != 5125 : isUnsigned))
    fail(say::accessorOfOtherKind, which, kind,
         floats ? "floats, or of 8 or 16 bits" : "unsigned whole numbers", count, textOf(row, "type"), type);
  if (count > text::raised(kMaxVertices) * 3) {
    text::reportLimit(diagnostics_, row.place, "an accessor has more elements than a model may have corners",
                      kMaxVertices, "vertices of one model, and a third of its corners", count / 3)
        .found = fmt::format("{} elements", count);
    throw Refused{};
  }
  GltfAccessor out{.row = &row,
                   .count = static_cast<std::uint32_t>(count),
                   .components = componentsOf(kind),
                   .type = static_cast<int>(type)};
  const JsonValue* normalized = row.find("normalized");
  out.normalized = normalized && normalized->flag;
  const std::size_t elementBytes = bytes * out.components;
  if (const auto unpacked = accessors_.find(number); unpacked != accessors_.end()) {
    out.stride = elementBytes;
    out.data = unpacked->second.data();
    if (unpacked->second.size() != count * elementBytes)
      fail(say::accessorOfOtherSize, row, unpacked->second.size(), count * elementBytes);
  } else if (const JsonValue* name = row.find("bufferView")) {
    const View from = view(*name);
    out.stride = from.stride != 0 ? from.stride : elementBytes;
    if (out.stride < elementBytes || out.stride > 4096 ||
        offset + out.stride * (count - 1) + elementBytes > from.bytes.size())
      fail(say::accessorBeyondView, row, from.bytes.size(), count, elementBytes, out.stride, offset);
    out.data = from.bytes.data() + offset;
  }
  return out;
}

template <class T>
std::vector<T> GltfDocument::read(const GltfAccessor& a) {
  std::vector<T> out(std::size_t{a.count} * a.components, T{});
  const std::size_t step = bytesOfType(static_cast<std::uint64_t>(a.type)),
                    elementBytes = step * a.components;
  const bool normalized = a.normalized && std::is_same_v<T, float>;
  const auto put = [&](std::size_t i, const char* element) {
    for (std::size_t c = 0; c < a.components; ++c)
      out[i * a.components + c] = static_cast<T>(componentAt(element + c * step, a.type, normalized));
  };
  if (a.data)
    for (std::size_t i = 0; i < a.count; ++i) put(i, a.data + i * a.stride);
  const JsonValue* sparse = a.row->find("sparse");  // elements that are given apart
  if (!sparse) return out;
  const JsonValue &indices = need(*sparse, "indices"), &values = need(*sparse, "values");
  const std::uint64_t count = whole(*sparse, "count"), type = whole(indices, "componentType"),
                      indexOffset = whole(indices, "byteOffset"), valueOffset = whole(values, "byteOffset");
  const std::string_view from = view(need(indices, "bufferView")).bytes,
                         to = view(need(values, "bufferView")).bytes;
  const std::size_t indexBytes = bytesOfType(type);
  if (count > a.count || indexBytes == 0 || type == 5126 || indexOffset + count * indexBytes > from.size() ||
      valueOffset + count * elementBytes > to.size())
    fail(say::sparseBeyondAccessor, *sparse, a.count);
  for (std::size_t i = 0; i < count; ++i) {
    const double at = componentAt(from.data() + indexOffset + i * indexBytes, static_cast<int>(type), false);
    if (at < 0 || at >= a.count) fail(say::sparseElementNotThere, *a.row, a.count, at);
    put(static_cast<std::size_t>(at), to.data() + valueOffset + i * elementBytes);
  }
  return out;
}

template std::vector<float> GltfDocument::read(const GltfAccessor&);
template std::vector<std::uint32_t> GltfDocument::read(const GltfAccessor&);

}  // namespace weft::assets
