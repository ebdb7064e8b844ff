#include "engine/assets/models/obj/obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

#include "engine/assets/models/obj/mtl.h"
#include "engine/assets/models/obj/polygon.h"
#include "engine/assets/models/parts/mesh_builder.h"
#include "engine/text/chars.h"
#include "engine/text/hash.h"

namespace weft::assets {

using text::Code;
using text::Diagnostics;

namespace {

constexpr std::size_t kLongestLine = 65536, kMaxCorners = 4096;
constexpr std::size_t kWork = 200'000'000;  // corners that are looked at to cut polygons
constexpr float kFarthest = 1e9f;           // as of everything in a scene

struct Corner {
  std::size_t position = 0, uv = kNoRow, normal = kNoRow;
  friend bool operator==(const Corner&, const Corner&) = default;
};
struct CornerHash {
  std::size_t operator()(const Corner& corner) const {
    return text::hashCombine(text::hashCombine(corner.position, corner.uv), corner.normal);
  }
};

class ObjReader {
 public:
  ObjReader(ModelFiles& files, const LoadObserver& observer, Diagnostics& diagnostics, Model& model)
      : files_(files),
        observer_(observer),
        diagnostics_(diagnostics),
        model_(model),
        builder_(model),
        materials_(files, diagnostics, model) {}

  bool read(std::string_view bytes) {
    const std::size_t before = diagnostics_.errorCount(), all = bytes.size();
    if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
    while (!bytes.empty() && diagnostics_.errorCount() == before) {
      if (line_ % 4096 == 0 && !goOn(static_cast<double>(all - bytes.size()) / static_cast<double>(all)))
        return false;
      readStatement(takeStatement(bytes));
    }
    reportLeftOut();
    if (diagnostics_.errorCount() > before || !materials_.finish(observer_)) return false;
    for (Part& part : parts_) {
      if (!goOn(1)) return false;
      finishPart(part);
    }
    return diagnostics_.errorCount() == before;
  }

 private:
  // Faces of one object with one material.
  struct Part {
    std::uint32_t node = 0, material = 0;
    std::vector<Corner> corners;  // three for each triangle
  };

  bool goOn(double done) const { return !observer_ || observer_(LoadStage::decoding, done / 2); }

  text::Place here() const {
    text::Place place = files_.place();
    place.line = line_;
    return place;
  }
  void fail(std::string message, std::string expected, std::string found) {
    diagnostics_.add({.code = Code::badModelValue,
                      .message = std::move(message),
                      .place = here(),
                      .expected = std::move(expected),
                      .found = std::move(found)});
  }

  // A line, and those that it goes on in behind '\\'.
  std::string takeStatement(std::string_view& bytes) {
    std::string statement;
    for (bool more = true; more && !bytes.empty();) {
      std::string_view line = text::takeLine(bytes);
      ++line_;
      if (line.ends_with('\r')) line.remove_suffix(1);
      more = line.ends_with('\\');
      if (more) line.remove_suffix(1);
      statement += line;
      if (more) statement += ' ';
      if (statement.size() <= kLongestLine) continue;
      fail("a line of the model is too long", fmt::format("lines of at most {} bytes", kLongestLine),
           fmt::format("{} bytes", statement.size()));
      return "";
    }
    return statement;
  }

  void readStatement(std::string_view rest) {
    const std::string_view key = text::takeWord(rest);
    if (key.empty() || key.starts_with('#')) return;
    const std::string name(text::trimmed(rest));
    rest = rest.substr(0, rest.find('#'));
    if (key == "v") {
      readVertex(rest);
    } else if (key == "vt") {
      if (const auto numbers = readNumbers<2>(rest, 1)) uvs_.push_back({(*numbers)[0], 1 - (*numbers)[1]});
    } else if (key == "vn") {
      if (const auto numbers = readNumbers<3>(rest, 3))
        normals_.push_back({(*numbers)[0], (*numbers)[1], (*numbers)[2]});
    } else if (key == "f" || key == "fo") {
      readFace(rest);
    } else if (key == "o" || key == "g") {
      node_ = nodeOf(name);
      part_ = nullptr;
    } else if (key == "usemtl") {
      material_ = materials_.rowOf(name, here());
      part_ = nullptr;
    } else if (key == "mtllib") {
      materials_.readLibraries(name, here());
    } else if (key != "s" && key != "mtllib") {
      leaveOut(std::string(key));
    }
  }

  void leaveOut(const std::string& what) {
    constexpr std::size_t kKinds = 20;
    const bool many = leftOut_.size() >= kKinds && !leftOut_.contains(what);
    leftOut_.try_emplace(many ? "other statements of the model were left out" : what, line_, 0u)
        .first->second.second += 1;
  }

  void reportLeftOut() {
    if (colored_ && colorless_)
      diagnostics_
          .warning(Code::modelPartLeftOut, files_.place(),
                   "the vertex colors were left out: some vertices have none")
          .hint = "export the mesh again, with a color for every vertex";
    for (const auto& [what, where] : leftOut_) {
      line_ = where.first;
      text::Diagnostic& d = diagnostics_.warning(
          Code::modelPartLeftOut, here(),
          what.find(' ') != what.npos ? what
                                      : fmt::format("statements '{}' of the model were left out", what));
      d.expected = "triangles and polygons: v, vt, vn, f, o, g, usemtl, mtllib";
      d.found = fmt::format("{} of them", where.second);
      if (what == "p" || what == "l") d.hint = "points and lines are not drawn";
    }
  }

  // At least `least` numbers, the rest 0.
  template <std::size_t N>
  std::optional<std::array<float, N>> readNumbers(std::string_view rest, std::size_t least) {
    std::array<float, N> numbers{};
    for (std::size_t i = 0; i < N; ++i) {
      std::string_view word = text::takeWord(rest);
      if (word.empty() && i >= least) break;
      if (word.starts_with('+')) word.remove_prefix(1);
      const std::optional<float> number = text::numberIn<float>(word);
      if (!number || !(std::abs(*number) <= kFarthest)) {
        fail("a number of the model cannot be used", fmt::format("finite numbers within {}", kFarthest),
             fmt::format("'{}'", word));
        return {};
      }
      numbers[i] = *number;
    }
    return numbers;
  }

  void readVertex(std::string_view rest) {
    std::string_view left = rest;
    std::size_t words = 0;
    while (!text::takeWord(left).empty()) ++words;
    const std::size_t color = words == 7 ? 4 : 3;  // behind w
    const auto n = readNumbers<7>(rest, 3);
    if (!n) return;
    positions_.push_back({(*n)[0], (*n)[1], (*n)[2]});
    colors_.emplace_back(1);
    colored_ = colored_ || words >= 6;
    colorless_ = colorless_ || words < 6;
    // The format does not say what its colors are; other programs take them for sRGB (Blender 3.4 and later, three.js).
    for (std::size_t c = 0; c < 3 && words >= 6; ++c)
      colors_.back()[static_cast<int>(c)] = decodeSrgb(std::clamp((*n)[color + c], 0.0f, 1.0f));
  }

  // A row of a table, counted from 1, or from its end when negative. False for one that there is not.
  static bool readRow(std::string_view word, std::size_t count, std::size_t& row) {
    const std::optional<std::int64_t> number = text::numberIn<std::int64_t>(word);
    if (!number || *number == 0) return false;
    const std::int64_t at = *number > 0 ? *number - 1 : static_cast<std::int64_t>(count) + *number;
    row = static_cast<std::size_t>(at);
    return at >= 0 && row < count;
  }

  // position, position/uv, position//normal or position/uv/normal
  std::optional<Corner> readCorner(std::string_view word) const {
    Corner corner;
    const std::size_t first = word.find('/'), second = first == word.npos ? first : word.find('/', first + 1);
    if (!readRow(word.substr(0, first), positions_.size(), corner.position)) return {};
    const std::string_view uv =
        first == word.npos ? std::string_view() : word.substr(first + 1, second - first - 1);
    const std::string_view normal = second == word.npos ? std::string_view() : word.substr(second + 1);
    if (!uv.empty() && !readRow(uv, uvs_.size(), corner.uv)) return {};
    if (!normal.empty() && !readRow(normal, normals_.size(), corner.normal)) return {};
    return corner;
  }

  void readFace(std::string_view rest) {
    std::vector<Corner> corners;
    std::vector<glm::dvec3> places;
    bool good = true;
    for (std::string_view word = text::takeWord(rest); !word.empty(); word = text::takeWord(rest)) {
      const std::optional<Corner> corner = readCorner(word);
      good = good && corner;
      if (!good) continue;
      corners.push_back(*corner);
      places.emplace_back(positions_[corner->position]);
      if (corners.size() > kMaxCorners)
        return fail("a face of the model has too many corners", fmt::format("at most {}", kMaxCorners),
                    "more");
    }
    if (!good) return leaveOut("faces that name what is not there were left out");
    if (corners.size() < 3) return leaveOut("faces of fewer than three corners were left out");
    const std::size_t all = (corners.size() - 2) * 3;
    if (!builder_.hasRoom(all, all, here(), diagnostics_)) return;
    if (!part_) part_ = &partOf();
    for (const auto& triangle : triangulate(places, work_))
      for (const std::size_t corner : triangle) part_->corners.push_back(corners[corner]);
  }

  std::uint32_t nodeOf(const std::string& name) {
    const auto [known, isNew] = nodes_.try_emplace(name, static_cast<std::uint32_t>(model_.nodes.size()));
    if (isNew) model_.nodes.push_back({.name = name});
    return known->second;
  }

  Part& partOf() {
    if (node_ == kNoRow) node_ = nodeOf(model_.name);
    const auto [known, isNew] = partRows_.try_emplace({node_, material_}, parts_.size());
    if (isNew) parts_.push_back({node_, material_, {}});
    return parts_[known->second];
  }

  void finishPart(Part& part) {
    RawMesh mesh;
    mesh.name = model_.nodes[part.node].name;
    mesh.colors = colored_ && !colorless_;
    mesh.normals = std::ranges::any_of(part.corners, [](const Corner& c) { return c.normal != kNoRow; });
    const glm::vec4 move = materials_.moveOf(part.material);
    std::unordered_map<Corner, std::uint32_t, CornerHash> known;
    for (std::size_t i = 0; i < part.corners.size(); ++i) {
      const Corner& corner = part.corners[i];
      const bool flat = corner.normal == kNoRow && mesh.normals;  // among others that are not
      const auto row = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.indices.push_back(flat ? row : known.try_emplace(corner, row).first->second);
      if (mesh.indices.back() != row) continue;
      RawVertex vertex{.position = positions_[corner.position]};
      if (corner.uv != kNoRow)
        vertex.uv = {uvs_[corner.uv].x * move.x + move.z, 1 - (1 - uvs_[corner.uv].y) * move.y - move.w};
      if (mesh.colors) vertex.color = glm::vec4(colors_[corner.position], 1);
      if (corner.normal != kNoRow) vertex.normal = normals_[corner.normal];
      if (flat) {
        std::array<glm::dvec3, 3> places;
        for (std::size_t c = 0; c < 3; ++c) places[c] = positions_[part.corners[i / 3 * 3 + c].position];
        vertex.normal = glm::vec3(areaOf(places));
      }
      mesh.vertices.push_back(vertex);
    }
    part.corners = {};
    model_.instances.push_back({part.node, builder_.add(std::move(mesh)), part.material, kNoRow});
  }

  ModelFiles& files_;
  const LoadObserver& observer_;
  Diagnostics& diagnostics_;
  Model& model_;
  MeshBuilder builder_;
  MtlReader materials_;
  std::uint32_t line_ = 0;
  std::vector<glm::vec3> positions_, normals_, colors_;
  std::vector<glm::vec2> uvs_;
  bool colored_ = false, colorless_ = false;
  std::uint32_t node_ = kNoRow, material_ = 0;
  std::map<std::string, std::uint32_t> nodes_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> partRows_;
  std::vector<Part> parts_;
  Part* part_ = nullptr;  // that faces go to
  std::size_t work_ = kWork;
  std::map<std::string, std::pair<std::uint32_t, unsigned>> leftOut_;  // the first line, and how many
};

}  // namespace

bool readObj(std::string_view bytes, ModelFiles& files, const LoadObserver& observer,
             Diagnostics& diagnostics, Model& model) {
  return files.isTextInLimit(bytes) && ObjReader(files, observer, diagnostics, model).read(bytes);
}

}  // namespace weft::assets
