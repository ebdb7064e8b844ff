#include "engine/assets/models/gltf/gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/assets/models/parts/model_files.h"
#include "engine/base/limits.h"

namespace weft::assets {

using base::Code;
using base::JsonValue;

namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t{1}
                                     << 40;  // no file is so large; sums of these do not overflow

// What an element of a mesh may ask for that Weft does, or that changes no picture when it is left out.
constexpr std::string_view kKnownExtensions[] = {"KHR_lights_punctual", "KHR_materials_emissive_strength",
                                                 "KHR_mesh_quantization", "KHR_texture_transform"};

std::uint32_t wordAt(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, 4);
  return word;
}

}  // namespace

base::Diagnostic& GltfDocument::fail(const JsonValue& where, std::string message) {
  base::Diagnostic& d = diagnostics_.error(Code::badModelValue, where.place, std::move(message));
  d.pointer = base::pointerAt(*root_, where.begin);
  return d;
}

base::Diagnostic& GltfDocument::leaveOut(const JsonValue& where, std::string message) {
  base::Diagnostic& d = diagnostics_.warning(Code::modelPartLeftOut, where.place, std::move(message));
  d.pointer = base::pointerAt(*root_, where.begin);
  return d;
}

// "glTF", version, length; then chunks of length, kind, bytes.
bool GltfDocument::split(std::string_view bytes, std::string_view& json, std::string_view& binary) {
  const auto bad = [&](std::string message, std::string expected, std::string found) {
    base::Diagnostic& d =
        diagnostics_.error(Code::unreadableModel, files_.place(),
                           fmt::format("cannot read model '{}': {}", files_.path(), message));
    d.expected = std::move(expected);
    d.found = std::move(found);
    d.hint = "export or download the model again";
    return false;
  };
  if (!bytes.starts_with("glTF")) {
    json = bytes;
    return true;
  }
  if (bytes.size() < 20)
    return bad("the file ends in its header", "20 bytes at least", fmt::format("{} bytes", bytes.size()));
  if (wordAt(bytes, 4) != 2)
    return bad("it is of another version of glTF", "version 2", fmt::format("version {}", wordAt(bytes, 4)));
  if (wordAt(bytes, 8) > bytes.size())
    return bad("the file ends early", fmt::format("{} bytes, as its header says", wordAt(bytes, 8)),
               fmt::format("{} bytes", bytes.size()));
  std::size_t at = 12;
  for (int chunk = 0; at + 8 <= bytes.size() && chunk < 2; ++chunk) {
    const std::size_t length = wordAt(bytes, at), kind = wordAt(bytes, at + 4);
    if (length > bytes.size() - at - 8)
      return bad(fmt::format("chunk {} reaches beyond the file", chunk),
                 fmt::format("at most {} bytes", bytes.size() - at - 8), fmt::format("{} bytes", length));
    if (chunk == 0 && kind != 0x4e4f534a)
      return bad("its first chunk is not JSON", "a chunk 'JSON'", "another one");
    if (chunk == 0) json = bytes.substr(at + 8, length);
    if (chunk == 1 && kind == 0x004e4942) binary = bytes.substr(at + 8, length);
    at += 8 + (length + 3) / 4 * 4;
  }
  return true;
}

bool GltfDocument::open(std::string bytes) {
  std::string_view json, binary;
  if (!split(bytes, json, binary)) return false;
  const std::size_t before = diagnostics_.errorCount();
  root_ = base::parseJson(json, std::make_shared<const std::string>(files_.path()), diagnostics_);
  if (!root_ || diagnostics_.errorCount() > before) return false;
  const JsonValue* asset = root_->find("asset");
  const std::string version = asset ? text(*asset, "version") : "";
  if (!version.starts_with("2.")) {
    base::Diagnostic& d = diagnostics_.error(Code::unreadableModel, root_->place,
                                             fmt::format("'{}' is no glTF 2.0 document", files_.path()));
    d.expected = "\"asset\": {\"version\": \"2.0\"}";
    d.found = asset ? fmt::format("version \"{}\"", version) : "no \"asset\"";
    return false;
  }
  for (const base::JsonMember& member : root_->members)
    if (member.value.is(JsonValue::Type::array))
      for (const JsonValue& row : member.value.items)
        if (!row.is(JsonValue::Type::object) && member.key != "extensionsUsed" &&
            member.key != "extensionsRequired") {
          base::Diagnostic& d = fail(row, fmt::format("a row of '{}' is no object", member.key));
          d.expected = "an object";
          d.found = describe(row);
          return false;
        }
  // The binary chunk's buffer points into `bytes`.
  if (!checkExtensions() || !readBuffers(binary)) return false;
  bytes.clear();
  bytes.shrink_to_fit();
  return readViews() && readAccessors();
}

bool GltfDocument::checkExtensions() {
  const JsonValue* required = root_->find("extensionsRequired");
  if (!required || !required->is(JsonValue::Type::array)) return true;
  for (const JsonValue& name : required->items)
    if (std::ranges::find(kKnownExtensions, name.text) == std::end(kKnownExtensions)) {
      base::Diagnostic& d = diagnostics_.error(
          Code::unreadableModel, name.place,
          fmt::format("the model needs the extension '{}', which Weft does not know", name.text));
      d.pointer = base::pointerAt(*root_, name.begin);
      d.expected = fmt::format("{}", fmt::join(kKnownExtensions, ", "));
      d.hint = "export the model without it, for example uncompressed";
      return false;
    }
  return true;
}

const std::vector<JsonValue>& GltfDocument::rows(std::string_view table) const {
  static const std::vector<JsonValue> kNone;
  const JsonValue* found = root_->find(table);
  return found && found->is(JsonValue::Type::array) ? found->items : kNone;
}

std::optional<std::uint32_t> GltfDocument::index(std::string_view table, const JsonValue* value) {
  return value ? indexOf(table, rows(table).size(), *value) : std::nullopt;
}

std::optional<std::uint32_t> GltfDocument::indexOf(std::string_view table, std::size_t count,
                                                   const JsonValue& value) {
  if (value.is(JsonValue::Type::number) && value.number >= 0 && value.number < static_cast<double>(count) &&
      value.number == std::floor(value.number))
    return static_cast<std::uint32_t>(value.number);
  base::Diagnostic& d = fail(value, fmt::format("there is no such row of '{}'", table));
  d.expected = count == 0 ? fmt::format("none: the file has no '{}'", table)
                          : fmt::format("an index from 0 to {}", count - 1);
  d.found = describe(value);
  return {};
}

std::optional<std::uint64_t> GltfDocument::whole(const JsonValue& object, std::string_view key,
                                                 std::uint64_t otherwise) {
  const JsonValue* value = object.find(key);
  if (!value) return otherwise;
  if (value->is(JsonValue::Type::number) && value->number >= 0 &&
      value->number <= static_cast<double>(kMostBytes) && value->number == std::floor(value->number))
    return static_cast<std::uint64_t>(value->number);
  base::Diagnostic& d = fail(*value, fmt::format("'{}' is no size", key));
  d.expected = fmt::format("a whole number from 0 to {}", kMostBytes);
  d.found = describe(*value);
  return {};
}

double GltfDocument::number(const JsonValue& object, std::string_view key, double otherwise, double min,
                            double max) {
  const JsonValue* value = object.find(key);
  if (!value) return otherwise;
  if (value->is(JsonValue::Type::number) && value->number >= min && value->number <= max)
    return value->number;
  base::Diagnostic& d = fail(*value, fmt::format("'{}' is out of range", key));
  d.expected = fmt::format("a number from {} to {}", min, max);
  d.found = describe(*value);
  return otherwise;
}

bool GltfDocument::numbers(const JsonValue& object, std::string_view key, std::size_t count, float* out) {
  const JsonValue* value = object.find(key);
  if (!value) return false;
  bool good = value->is(JsonValue::Type::array) && value->items.size() == count;
  for (std::size_t i = 0; good && i < count; ++i) {
    const JsonValue& item = value->items[i];
    good = item.is(JsonValue::Type::number) && std::abs(item.number) <= 1e9;
    if (good) out[i] = static_cast<float>(item.number);
  }
  if (good) return true;
  base::Diagnostic& d = fail(*value, fmt::format("'{}' does not hold {} numbers", key, count));
  d.expected = fmt::format("{} numbers within 1e9", count);
  d.found = describe(*value);
  return false;
}

std::string GltfDocument::text(const JsonValue& object, std::string_view key) const {
  const JsonValue* value = object.find(key);
  return value && value->is(JsonValue::Type::string) ? value->text : "";
}

bool GltfDocument::readBuffers(std::string_view binary) {
  bool good = true;
  for (std::size_t i = 0; i < rows("buffers").size(); ++i) {
    const JsonValue& row = rows("buffers")[i];
    const auto length = whole(row, "byteLength", 0);
    const JsonValue* uri = row.find("uri");
    std::string bytes;
    if (uri && uri->is(JsonValue::Type::string) && uri->text.starts_with("data:")) {
      auto decoded = decodeDataUri(uri->text);
      if (!decoded) fail(*uri, fmt::format("buffer {} holds damaged base64", i)).expected = "data:…;base64,…";
      if (!decoded || !files_.count(decoded->size(), uri->place)) good = false;
      if (decoded) bytes = std::move(*decoded);
    } else if (uri) {
      auto read = files_.readBeside(uri->text, uri->place, Code::unreadableModel, true);
      if (!read) good = false;
      if (read) bytes = std::move(*read);
    } else {
      bytes = std::string(binary);
    }
    if (!good || !length) return false;
    if (*length > bytes.size()) {
      base::Diagnostic& d = fail(row, fmt::format("buffer {} is shorter than it says", i));
      d.expected = fmt::format("{} bytes", *length);
      d.found = fmt::format("{} bytes", bytes.size());
      d.hint = "export or download the model again";
      return false;
    }
    buffers_.push_back(std::move(bytes));
  }
  return good;
}

bool GltfDocument::readViews() {
  bool good = true;
  for (std::size_t i = 0; i < rows("bufferViews").size(); ++i) {
    const JsonValue& row = rows("bufferViews")[i];
    const auto buffer = index("buffers", row.find("buffer"));
    const auto offset = whole(row, "byteOffset", 0), length = whole(row, "byteLength", 0),
               stride = whole(row, "byteStride", 0);
    View& view = views_.emplace_back();
    if (!buffer) {
      if (!row.find("buffer"))
        fail(row, fmt::format("buffer view {} names no buffer", i)).expected = "\"buffer\"";
      good = false;
      continue;
    }
    if (!offset || !length || !stride) {
      good = false;
      continue;
    }
    if (*offset + *length > buffers_[*buffer].size()) {
      base::Diagnostic& d = fail(row, fmt::format("buffer view {} reaches beyond its buffer", i));
      d.expected = fmt::format("an end of at most {} bytes", buffers_[*buffer].size());
      d.found = fmt::format("{} bytes from {}", *length, *offset);
      good = false;
      continue;
    }
    view = {std::string_view(buffers_[*buffer]).substr(*offset, *length), *stride};
  }
  return good;
}

bool GltfDocument::readAccessors() {
  bool good = true;
  for (const JsonValue& row : rows("accessors")) good = readAccessor(row) && good;
  return good;
}

bool GltfDocument::readAccessor(const JsonValue& value) {
  const std::size_t number = accessors_.size();
  GltfAccessor& out = accessors_.emplace_back();
  const auto count = whole(value, "count", 0), offset = whole(value, "byteOffset", 0),
             type = whole(value, "componentType", 0);
  out.kind = text(value, "type");
  out.components = componentsOf(out.kind);
  if (!count || !offset || !type) return false;
  const std::size_t componentBytes = bytesOfType(static_cast<int>(*type));
  if (componentBytes == 0 || out.components == 0 || *count == 0) {
    base::Diagnostic& d = fail(value, fmt::format("accessor {} is of no known kind", number));
    d.expected = "a 'count' of at least 1, a 'type' such as \"VEC3\", a 'componentType' from 5120 to 5126";
    d.found = fmt::format("count {}, type \"{}\", componentType {}", *count, out.kind, *type);
    return false;
  }
  const std::uint64_t most = base::raised(kMostVertices) * 3;
  if (*count > most) {
    base::reportLimit(diagnostics_, value.place,
                      fmt::format("accessor {} has more elements than a model may have corners", number),
                      kMostVertices, "vertices of one model, and a third of its corners", *count / 3)
        .found = fmt::format("{} elements", *count);
    return false;
  }
  out.count = static_cast<std::uint32_t>(*count);
  out.type = static_cast<int>(*type);
  const JsonValue* normalized = value.find("normalized");
  out.normalized = normalized && normalized->flag;
  const std::size_t elementBytes = componentBytes * out.components;
  out.stride = elementBytes;
  if (const JsonValue* name = value.find("bufferView")) {
    const auto row = index("bufferViews", name);
    if (!row) return false;
    const View& from = views_[*row];
    if (from.stride != 0) out.stride = from.stride;
    const std::uint64_t end = *offset + out.stride * (*count - 1) + elementBytes;
    if (out.stride < elementBytes || out.stride > 4096 || end > from.bytes.size()) {
      base::Diagnostic& d = fail(value, fmt::format("accessor {} reaches beyond its buffer view", number));
      d.expected = fmt::format("an end of at most {} bytes", from.bytes.size());
      d.found = fmt::format("{} elements of {} bytes, {} apart, from {}", *count, elementBytes, out.stride,
                            *offset);
      return false;
    }
    out.data = from.bytes.data() + *offset;
  }
  return readSparse(value, out, elementBytes);
}

bool GltfDocument::readSparse(const JsonValue& value, GltfAccessor& out, std::size_t elementBytes) {
  const JsonValue* sparse = value.find("sparse");
  if (!sparse) return true;
  const auto bad = [&] {
    base::Diagnostic& d = fail(*sparse, "a sparse accessor reaches beyond what it changes");
    d.expected = fmt::format("indices below {}, in buffer views that hold them", out.count);
    return false;
  };
  const JsonValue *indices = sparse->find("indices"), *values = sparse->find("values");
  const auto count = whole(*sparse, "count", 0);
  if (!count || *count > out.count || !indices || !values) return bad();
  const auto indexView = index("bufferViews", indices->find("bufferView")),
             valueView = index("bufferViews", values->find("bufferView"));
  const auto indexOffset = whole(*indices, "byteOffset", 0), valueOffset = whole(*values, "byteOffset", 0);
  const auto type = whole(*indices, "componentType", 0);
  if (!indexView || !valueView || !indexOffset || !valueOffset || !type) return bad();
  const std::size_t indexBytes = bytesOfType(static_cast<int>(*type));
  const std::string_view from = views_[*indexView].bytes, to = views_[*valueView].bytes;
  if (indexBytes == 0 || *type == 5126 || *indexOffset + *count * indexBytes > from.size() ||
      *valueOffset + *count * elementBytes > to.size())
    return bad();
  out.sparse = static_cast<std::uint32_t>(*count);
  out.sparseType = static_cast<int>(*type);
  out.sparseIndices = from.data() + *indexOffset;
  out.sparseValues = to.data() + *valueOffset;
  for (std::size_t i = 0; i < out.sparse; ++i) {
    const double at = componentAt(out.sparseIndices + i * indexBytes, out.sparseType, false);
    if (at < 0 || at >= out.count) return bad();
  }
  return true;
}

const GltfAccessor* GltfDocument::accessor(const JsonValue* value, std::string_view kind, bool floats) {
  const auto row = index("accessors", value);
  if (!row) return nullptr;
  const GltfAccessor& found = accessors_[*row];
  const bool quantized = floats && found.type != 5125;
  if (found.kind == kind && (floats ? found.type == 5126 || quantized
                                    : found.type == 5121 || found.type == 5123 || found.type == 5125))
    return &found;
  base::Diagnostic& d = fail(*value, fmt::format("accessor {} is of another kind than is needed here", *row));
  d.expected =
      fmt::format("\"{}\" of {}", kind, floats ? "floats, or of 8 or 16 bits" : "unsigned whole numbers");
  d.found = fmt::format("\"{}\", componentType {}", found.kind, found.type);
  return nullptr;
}

std::string_view GltfDocument::kindOf(const JsonValue& accessor) const {
  const bool known = accessor.is(JsonValue::Type::number) && accessor.number >= 0 &&
                     accessor.number < static_cast<double>(accessors_.size());
  return known ? accessors_[static_cast<std::size_t>(accessor.number)].kind : std::string_view();
}

std::optional<std::string_view> GltfDocument::view(const JsonValue* value) {
  const auto row = index("bufferViews", value);
  if (!row) return {};
  return views_[*row].bytes;
}

}  // namespace weft::assets
