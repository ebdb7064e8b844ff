// Geometry that Draco or meshoptimizer packed. Declared in gltf_document.h.
#include <draco/compression/decode.h>
#include <fmt/format.h>
#include <meshoptimizer.h>

#include <cstring>
#include <exception>

#include "assets_sentences.h"
#include "engine/assets/models/gltf/gltf_document.h"

namespace weft::assets {

using text::JsonValue;

namespace {

// All values of an attribute as numbers of type T, one element for each point.
template <class T>
std::string valuesOf(const draco::Mesh& mesh, const draco::PointAttribute& attribute) {
  const auto components = static_cast<std::size_t>(attribute.num_components());
  std::string bytes(mesh.num_points() * components * sizeof(T), 0);
  std::vector<T> value(components);
  for (std::uint32_t i = 0; i < mesh.num_points(); ++i) {
    attribute.ConvertValue<T>(attribute.mapped_index(draco::PointIndex(i)),
                              static_cast<std::int8_t>(components), value.data());
    std::memcpy(bytes.data() + i * components * sizeof(T), value.data(), components * sizeof(T));
  }
  return bytes;
}

std::string cornersOf(const draco::Mesh& mesh, std::size_t bytesEach) {
  std::string bytes(std::size_t{mesh.num_faces()} * 3 * bytesEach, 0);
  for (std::uint32_t f = 0; f < mesh.num_faces(); ++f)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t point = mesh.face(draco::FaceIndex(f))[c].value();
      std::memcpy(bytes.data() + (f * 3 + c) * bytesEach, &point, bytesEach);  // little-endian, as glTF is
    }
  return bytes;
}

}  // namespace

void GltfDocument::unpackDraco(const JsonValue& primitive) {
  const JsonValue* packed = valueOf(primitive, {"extensions", "KHR_draco_mesh_compression"});
  if (!packed) return;
  const std::string_view bytes = view(need(*packed, "bufferView")).bytes;
  std::unique_ptr<draco::Mesh> mesh;
  std::string why;
  try {
    draco::DecoderBuffer buffer;
    buffer.Init(bytes.data(), bytes.size());
    auto decoded = draco::Decoder().DecodeMeshFromBuffer(&buffer);
    if (decoded.ok())
      mesh = std::move(decoded).value();
    else
      why = decoded.status().error_msg_string();
  } catch (const std::exception& e) {
    why = e.what();
  }
  if (!mesh) fail(say::damagedDraco, *packed, why);
  const auto typeOf = [&](std::size_t row) { return whole(rows("accessors")[row], "componentType"); };
  const auto keep = [&](std::size_t row, std::string unpacked) {
    refuseUnless(files_.count(unpacked.size(), packed->place));
    accessors_[row] = std::move(unpacked);
  };
  for (const text::JsonMember& member : need(*packed, "attributes").members) {
    const JsonValue* which = valueOf(primitive, {"attributes", member.key});
    const draco::PointAttribute* attribute =
        mesh->GetAttributeByUniqueId(static_cast<std::uint32_t>(index("attributes", 1 << 20, member.value)));
    if (!which || !attribute) fail(say::notInBoth, member.value, member.key);
    const std::size_t row = index("accessors", *which);
    keep(row, withComponent(static_cast<int>(typeOf(row)),
                            [&]<class T>(T) { return valuesOf<T>(*mesh, *attribute); }));
  }
  const JsonValue* which = primitive.find("indices");
  if (!which) return;
  const std::size_t row = index("accessors", *which);
  keep(row, cornersOf(*mesh, typeOf(row) == 5121 ? 1 : typeOf(row) == 5123 ? 2 : 4));
}

std::string GltfDocument::unpackMeshopt(const JsonValue& packed) {
  const std::string& buffer = buffers_[index("buffers", need(packed, "buffer"))];
  const std::uint64_t offset = whole(packed, "byteOffset"), length = whole(packed, "byteLength"),
                      stride = whole(packed, "byteStride"), count = whole(packed, "count");
  const std::string mode = textOf(packed, "mode"), filter = textOf(packed, "filter", "NONE");
  const bool vertices = mode == "ATTRIBUTES", triangles = mode == "TRIANGLES";
  const bool fits = vertices ? stride % 4 == 0 && stride > 0 && stride <= 256
                             : (triangles || mode == "INDICES") && (stride == 2 || stride == 4) &&
                                   (count % 3 == 0 || !triangles);
  if (!fits || offset + length > buffer.size())
    fail(say::viewNotAsSaid, packed, mode, count, stride, length, offset);
  refuseUnless(count <= kMaxModelBytes && files_.count(count * stride, packed.place));
  std::string out(count * stride, 0);
  const auto* from = reinterpret_cast<const unsigned char*>(buffer.data() + offset);
  const int wrong = vertices    ? meshopt_decodeVertexBuffer(out.data(), count, stride, from, length)
                    : triangles ? meshopt_decodeIndexBuffer(out.data(), count, stride, from, length)
                                : meshopt_decodeIndexSequence(out.data(), count, stride, from, length);
  if (wrong != 0) fail(say::damagedView, packed);
  if (filter == "OCTAHEDRAL" && (stride == 4 || stride == 8))
    meshopt_decodeFilterOct(out.data(), count, stride);
  else if (filter == "QUATERNION" && stride == 8)
    meshopt_decodeFilterQuat(out.data(), count, stride);
  else if (filter == "EXPONENTIAL" && stride % 4 == 0)
    meshopt_decodeFilterExp(out.data(), count, stride);
  else if (filter != "NONE")
    fail(say::unknownFilter, packed, filter, stride);
  return out;
}

}  // namespace weft::assets
