#include "engine/assets/models/obj/obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>

#include "assets_sentences.h"
#include "engine/assets/models/parts/mesh_builder.h"
#include "engine/assets/models/parts/texture_pool.h"
#include "engine/text/chars.h"
#include "engine/text/hash.h"
#include "engine/text/json/dom.h"

namespace weft::assets {

using text::Code;
using text::Diagnostics;
using text::Place;

namespace {

constexpr std::size_t kLongestLine = 65536, kMaxCorners = 4096;
constexpr std::size_t kWork = 200'000'000;  // corners that are looked at to cut polygons

// ---- materials ----

// What changes no picture here: the model of illumination, ambient light, refraction and what filters it.
const std::set<std::string_view> kUnseen = {"illum", "Ka", "map_Ka", "Ni", "Tf", "sharpness", "Km"};

float numberOf(std::string_view& rest, float otherwise, float most = 1) {
  const auto number = text::numberIn<float>(text::takeWord(rest));
  return number ? std::clamp(*number, 0.0f, most) : otherwise;
}

// One number is gray.
glm::vec3 colorOf(std::string_view rest, float most = 1) {
  glm::vec3 color(numberOf(rest, 0, most));
  if (text::trimmed(rest).empty()) return color;
  color.y = numberOf(rest, 0, most);
  color.z = numberOf(rest, 0, most);
  return color;
}

class MtlReader {
 public:
  // Row 0 of Model::materials is that of faces without one.
  MtlReader(ModelFiles& files, Model& model)
      : files_(files), diagnostics_(files.diagnostics()), model_(model), pool_(files), rows_(1) {
    model_.materials.push_back({.name = "default", .albedo = glm::vec3(0.6f)});
  }

  // What `mtllib` says: a file, or several.
  void readLibraries(const std::string& names, const Place& place) {
    if (files_.hasBeside(names)) return readLibrary(names, place);
    std::string_view rest = names;
    for (std::string_view name = text::takeWord(rest); !name.empty(); name = text::takeWord(rest))
      readLibrary(std::string(name), place);
  }

  // What `usemtl` says; row 0 and W168 for a name that no library has, unless one is missing.
  std::uint32_t rowOf(const std::string& name, const Place& place) {
    if (const auto known = known_.find(name); known != known_.end()) return known->second;
    if (!missing_)
      leaveOut(fmt::format("the material '{}', which no library of the model has,", name), place);
    return 0;
  }

  // How texture coordinates of a material are moved, v upwards: scale in xy, offset in zw.
  glm::vec4 moveOf(std::uint32_t material) const { return rows_[material].move; }

  // Of faces without texture coordinates.
  void reportUvs(std::uint32_t row, const std::string& mesh) {
    if (const std::string& name = model_.materials[row].name;
        !rows_[row].maps.empty() && said_.insert(name).second)
      diagnostics_.warning(say::mapsWithoutUv, files_.place(), name, mesh, "'vt' at each corner");
  }

  // Decodes the maps. False when the load was stopped, or after errors.
  bool finish() {
    const std::size_t before = diagnostics_.errorCount();
    for (std::size_t i = 0; i < rows_.size(); ++i) finishRow(i);
    if (!pool_.finish(model_) || diagnostics_.errorCount() > before) return false;
    for (std::size_t i = 1; i < rows_.size(); ++i) {
      Material& material = model_.materials[i];
      material.blend = material.alpha < 1;
      if (!rows_[i].maps.contains("d") || material.albedoMap == kNoRow) continue;
      // What is hardly anywhere between is cut out, else mixed.
      const std::vector<std::uint8_t>& texels = model_.textures[material.albedoMap].image->texels;
      std::size_t between = 0;
      for (std::size_t t = 3; t < texels.size(); t += 4) between += texels[t] > 12 && texels[t] < 243 ? 1 : 0;
      material.blend = material.blend || between * 80 > texels.size();  // a twentieth
      if (!material.blend) material.alphaCutoff = 0.5f;
    }
    return true;
  }

 private:
  struct Map {
    std::uint32_t image = kNoRow;  // of the pool
    std::string name;
    text::Place place;
    std::uint8_t sampler = repeat;
    glm::vec4 move{1, 1, 0, 0};
    float strength = 1;
  };
  struct Row {
    std::map<std::string, Map, std::less<>> maps;  // by what they are of: "Kd"
    bool physical = false;                         // it has Pr or Pm
    glm::vec4 move{1, 1, 0, 0};
  };

  void leaveOut(std::string what, const Place& place) {
    if (said_.size() >= 1000) what = "more of the model's materials";
    if (said_.insert(what).second) diagnostics_.warning(say::leftOut, place, what, "");
  }

  void readLibrary(const std::string& name, const Place& place) {
    std::string path = name;
    std::ranges::replace(path, '\\', '/');
    if (!libraries_.insert(path).second) return;
    const auto bytes = files_.readOptional(path, place, Code::modelPartLeftOut, false);
    missing_ = missing_ || !bytes;
    if (!bytes) return;
    std::string_view rest = *bytes;
    if (rest.starts_with(text::kByteOrderMark)) rest.remove_prefix(text::kByteOrderMark.size());
    Place here{files_.files().back()};
    while (!rest.empty()) {
      ++here.line;
      readStatement(text::takeLine(rest), here);
    }
  }

  void readStatement(std::string_view rest, const Place& place) {
    const std::string key(text::takeWord(rest));
    if (key.empty() || key.starts_with('#') || kUnseen.contains(key)) return;
    if (key == "newmtl") {
      const std::string name(text::trimmed(rest));
      // The first of a name stays.
      if (!known_.try_emplace(name, static_cast<std::uint32_t>(rows_.size())).second)
        leaveOut(fmt::format("a second material '{}'", name), place);
      rows_.emplace_back();
      model_.materials.push_back({.name = name, .albedo = glm::vec3(0.6f), .roughness = 0.5f});
      return;
    }
    if (rows_.size() == 1) return leaveOut(fmt::format("'{}' before any 'newmtl'", key), place);
    Material& material = model_.materials.back();
    Row& row = rows_.back();
    const bool map = key.starts_with("map_");
    if (map || key == "bump" || key == "norm" || key == "disp" || key == "decal" || key == "refl") {
      readMap(map ? key.substr(4) : key, rest, place);
    } else if (key == "Kd") {
      material.albedo = colorOf(rest);
    } else if (key == "Ks") {
      material.specular = colorOf(rest);
    } else if (key == "Ke") {
      material.emissive = colorOf(rest, 1e6f);
    } else if (key == "Ns") {
      material.shininess = numberOf(rest, 0, 10000);
    } else if (key == "d" || key == "Tr") {
      const float value = numberOf(rest, key == "d" ? 1 : 0);
      material.alpha = key == "d" ? value : 1 - value;
    } else if (key == "Pr" || key == "Pm") {
      (key == "Pr" ? material.roughness : material.metallic) = numberOf(rest, key == "Pr" ? 0.5f : 0);
      row.physical = true;
    } else if (numberOf(rest, 1) != 0) {  // Blender writes sheen and clear coat of 0
      leaveOut(fmt::format("'{}' of the material '{}'", key, material.name), place);
    }
  }

  void readMap(const std::string& of, std::string_view rest, const Place& place) {
    Map map{.place = place};
    const std::string what =
        fmt::format("of the map '{}' of the material '{}'", of, model_.materials.back().name);
    while (text::trimmed(rest).starts_with('-')) {
      const std::string option(text::takeWord(rest));
      std::vector<std::string> words;
      std::string_view after = rest;
      const bool moves = option == "-o" || option == "-s" || option == "-t";
      const std::size_t most = moves ? 3 : option == "-mm" ? 2 : 1;
      while (words.size() < most) {
        const std::string word(text::takeWord(after));
        if (moves && !text::numberIn<float>(word)) break;
        words.push_back(word);
        rest = after;
      }
      const auto wordOf = [&](std::size_t i, float otherwise) {
        return i < words.size() ? text::numberIn<float>(words[i]).value_or(otherwise) : otherwise;
      };
      if (option == "-clamp") {
        map.sampler = words[0] == "on" ? clampU | clampV : repeat;
      } else if (option == "-bm") {
        map.strength = wordOf(0, 1);
      } else if (option == "-s") {
        map.move.x = wordOf(0, 1);
        map.move.y = wordOf(1, 1);
      } else if (option == "-o") {
        map.move.z = wordOf(0, 0);
        map.move.w = wordOf(1, 0);
      } else if (option != "-blendu" && option != "-blendv" && option != "-texres" && option != "-cc" &&
                 !(option == "-mm" && wordOf(0, 0) == 0 && wordOf(1, 1) == 1) &&
                 !(option == "-t" && wordOf(0, 0) == 0 && wordOf(1, 0) == 0)) {
        leaveOut(fmt::format("'{}' {}", option, what), place);
      }
    }
    static const std::set<std::string_view> kKnown = {"Kd",   "Ke",   "d",    "Pr", "Pm",
                                                      "bump", "Bump", "norm", "Kn"};
    if (!kKnown.contains(of))
      return leaveOut(fmt::format("the map '{}' of the material '{}'", of, model_.materials.back().name),
                      place);
    const std::string name = files_.namedBeside(std::string(text::trimmed(rest)));
    if (!images_.contains(name)) {
      auto bytes = files_.readOptional(name, place, Code::missingModelTexture, false);
      images_[name] = bytes ? pool_.put(std::move(*bytes), name, place) : kNoRow;
    }
    map.image = images_[name];
    map.name = name;
    rows_.back().maps.insert_or_assign(of == "Bump" ? "bump" : of == "Kn" ? "norm" : of, std::move(map));
  }

  void finishRow(std::size_t number) {
    Row& row = rows_[number];
    Material& material = model_.materials[number];
    const auto take = [&](std::string_view of) {
      const auto found = row.maps.find(of);
      return found == row.maps.end() ? nullptr : &found->second;
    };
    const auto use = [&](std::uint32_t Material::*slot, std::size_t place, const Map* map, TextureUse as) {
      if (!map) return;
      material.*slot = pool_.use(map->image, map->name, as, map->place);
      material.samplers[place] = map->sampler;
    };
    const Map *color = take("Kd"), *holes = take("d"), *rough = take("Pr"), *metal = take("Pm");
    use(&Material::albedoMap, 0, color, TextureUse::color);
    if (!row.physical && !rough && !metal) toMetallicRoughness(material);
    if (holes && holes->image != kNoRow) {
      // Its alpha, or its brightness where it has none.
      const int channel = pool_.hasAlpha(holes->image) ? 3 : 0;
      material.albedoMap = pool_.useMade(
          color ? color->image : kNoRow, holes->image,
          [channel](const glm::u8vec4& c, const glm::u8vec4& d) {
            return glm::u8vec4(c.r, c.g, c.b, d[channel]);
          },
          holes->name, TextureUse::color, holes->place);
      material.samplers[0] = (color ? color : holes)->sampler;
    }
    use(&Material::emissiveMap, 4, take("Ke"), TextureUse::color);
    if (take("Ke") && material.emissive == glm::vec3(0)) material.emissive = glm::vec3(1);
    const Map *normal = take("norm"), *bump = normal ? normal : take("bump");
    use(&Material::normalMap, 1, bump, normal ? TextureUse::numbers : TextureUse::bump);
    if (bump) material.normalScale = bump->strength;
    if (rough || metal) {
      if (rough) material.roughness = 1;
      if (metal) material.metallic = 1;
      const Map* either = rough ? rough : metal;
      material.metallicRoughnessMap = pool_.useMade(
          rough ? rough->image : kNoRow, metal ? metal->image : kNoRow,
          [](const glm::u8vec4& r, const glm::u8vec4& m) { return glm::u8vec4(255, r.r, m.r, 255); },
          either->name, TextureUse::numbers, either->place);
      material.samplers[2] = either->sampler;
    }
    for (const auto& [of, map] : row.maps) {
      if (&map != &row.maps.begin()->second && row.move != map.move)
        leaveOut(
            fmt::format("'-o' or '-s' of the map '{}' of the material '{}', unlike that of its other maps,",
                        of, material.name),
            map.place);
      else
        row.move = map.move;
    }
  }

  ModelFiles& files_;
  text::Diagnostics& diagnostics_;
  Model& model_;
  TexturePool pool_;
  std::vector<Row> rows_;  // parallel to the materials of the model
  std::map<std::string, std::uint32_t> known_, images_;
  std::set<std::string> said_, libraries_;
  bool missing_ = false;  // a library
};

// ---- faces ----

double turnOf(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Twice its area times its normal: Newell, 1972.
glm::dvec3 areaOf(std::span<const glm::dvec3> polygon) {
  glm::dvec3 sum(0);
  for (std::size_t i = 0; i < polygon.size(); ++i)
    sum += glm::cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
  return sum;
}

// Rows of the corners of a polygon that is nearly flat; of a convex one a fan. `work` counts down; when it is used up, all are
// fans. Ears are cut off, one after another: Meisters, "Polygons have ears", 1975.
std::vector<std::array<std::size_t, 3>> triangulate(std::span<const glm::dvec3> polygon, std::size_t& work) {
  // Seen along the axis that its normal is nearest to, counter-clockwise.
  const glm::dvec3 area = areaOf(polygon), size = glm::abs(area);
  const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
  std::vector<glm::dvec2> at;
  for (const glm::dvec3& p : polygon) {
    const glm::dvec2 seen(p[(axis + 1) % 3], p[(axis + 2) % 3]);
    at.push_back(area[axis] < 0 ? glm::dvec2(seen.y, seen.x) : seen);
  }
  std::vector<std::size_t> left(polygon.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  const auto isEar = [&](std::size_t a, std::size_t b, std::size_t c) {
    if (turnOf(at[a], at[b], at[c]) <= 0) return false;
    for (const std::size_t other : left)
      if (at[other] != at[a] && at[other] != at[b] && at[other] != at[c] &&
          turnOf(at[a], at[b], at[other]) >= 0 && turnOf(at[b], at[c], at[other]) >= 0 &&
          turnOf(at[c], at[a], at[other]) >= 0)
        return false;
    return true;
  };
  std::vector<std::array<std::size_t, 3>> out;
  std::size_t next = 1, misses = 0;  // one after another, that are no ears
  while (left.size() > 3) {
    const std::size_t b = next % left.size(), a = (b + left.size() - 1) % left.size(),
                      c = (b + 1) % left.size();
    const bool looks = misses < left.size() && work >= left.size();
    if (looks) work -= left.size();
    if (looks && !isEar(left[a], left[b], left[c])) {
      ++next;
      ++misses;
      continue;
    }
    out.push_back({left[a], left[b], left[c]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(b));
    next = b;
    misses = 0;
  }
  if (left.size() == 3) out.push_back({left[0], left[1], left[2]});
  return out;
}

// Rows of position, uv and normal; kNoRow for a uv or a normal that is not named, and kMade on for normals that are made.
using Corner = std::array<std::size_t, 3>;
constexpr std::size_t kMade = std::size_t{kNoRow} + 1;
struct CornerHash {
  std::size_t operator()(const Corner& corner) const {
    return text::hashCombine(text::hashCombine(corner[0], corner[1]), corner[2]);
  }
};

class ObjReader {
 public:
  ObjReader(ModelFiles& files, Model& model) : files_(files), model_(model) {}

  bool read(std::string_view bytes) {
    const std::size_t before = diagnostics_.errorCount();
    if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
    while (!bytes.empty() && diagnostics_.errorCount() == before) {
      if (line_ % 4096 == 0 && files_.stop().stop_requested()) return false;
      readStatement(takeStatement(bytes));
    }
    reportLeftOut();
    if (diagnostics_.errorCount() > before || !materials_.finish()) return false;
    for (Part& part : parts_) {
      if (files_.stop().stop_requested()) return false;
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

  text::Place here() const {
    text::Place place = files_.place();
    place.line = line_;
    return place;
  }
  template <class... Args>
  void fail(text::Saying<Args...> what, Args&&... args) {
    diagnostics_.error<Args...>(what, here(), std::forward<Args>(args)...);
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
      fail(say::lineTooLong, kLongestLine, statement.size());
      return "";
    }
    return statement;
  }

  void readStatement(std::string_view rest) {
    const std::string_view key = text::takeWord(rest);
    if (key.empty() || key.starts_with('#')) return;
    const std::string name(text::trimmed(rest));
    rest = rest.substr(0, rest.find('#'));
    if (key == "v") return readVertex(rest);
    if (key == "f" || key == "fo") return readFace(rest);
    if (key == "mtllib") return materials_.readLibraries(name, here());
    if (key == "vt") {
      if (const auto numbers = readNumbers<2>(rest, 1, 1e30f))
        uvs_.push_back({(*numbers)[0], 1 - (*numbers)[1]});
    } else if (key == "vn") {
      if (const auto numbers = readNumbers<3>(rest, 3))
        normals_.push_back({(*numbers)[0], (*numbers)[1], (*numbers)[2]});
    } else if (key == "o" || key == "g") {
      node_ = nodeOf(name);
      part_ = nullptr;
    } else if (key == "usemtl") {
      material_ = materials_.rowOf(name, here());
      part_ = nullptr;
    } else if (key == "s") {
      group_ = text::numberIn<std::uint32_t>(name).value_or(0);  // "off"
    } else {
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
    if (colored_ && colorless_) diagnostics_.warning(say::colorsLeftOut, files_.place());
    for (const auto& [what, where] : leftOut_) {
      line_ = where.first;
      const bool sentence = what.find(' ') != what.npos, drawn = what != "p" && what != "l";
      diagnostics_.warning(say::objPartsLeftOut, here(),
                           sentence ? what : fmt::format("statements '{}' of the model were left out", what),
                           where.second, drawn ? "" : "points and lines are not drawn");
    }
  }

  // At least `least` numbers, the rest 0.
  template <std::size_t N>
  std::optional<std::array<float, N>> readNumbers(std::string_view rest, std::size_t least,
                                                  float most = kFarthest) {
    std::array<float, N> numbers{};
    for (std::size_t i = 0; i < N; ++i) {
      std::string_view word = text::takeWord(rest);
      if (word.empty() && i >= least) break;
      if (word.starts_with('+')) word.remove_prefix(1);
      const std::optional<float> number = text::numberIn<float>(word);
      if (!number || !(std::abs(*number) <= most)) {
        fail(say::numberNotUsable, most, word);
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

  // position, position/uv, position//normal or position/uv/normal: rows counted from 1, or from the end of the table when negative.
  // Empty for one that there is not.
  std::optional<Corner> readCorner(std::string_view word) const {
    const std::size_t counts[] = {positions_.size(), uvs_.size(), normals_.size()};
    Corner corner{kNoRow, kNoRow, kNoRow};
    for (std::size_t i = 0; i < 3 && (i == 0 || !word.empty()); ++i) {
      const std::string_view part = word.substr(0, i == 2 ? word.npos : word.find('/'));
      word.remove_prefix(std::min(part.size() + 1, word.size()));
      const auto count = static_cast<std::int64_t>(counts[i]);
      if (i > 0 && (part.empty() || count == 0)) continue;  // of what the file has nothing
      const std::int64_t number = text::numberIn<std::int64_t>(part).value_or(0);
      const std::int64_t at = number > 0 ? number - 1 : count + number;
      if (number == 0 || at < 0 || at >= count) return {};
      corner[i] = static_cast<std::size_t>(at);
    }
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
      places.emplace_back(positions_[(*corner)[0]]);
      if (corners.size() > kMaxCorners) return fail(say::tooManyCorners, kMaxCorners);
    }
    if (!good) return leaveOut("faces that name what is not there were left out");
    if (corners.size() < 3) return leaveOut("faces of fewer than three corners were left out");
    const std::size_t all = (corners.size() - 2) * 3;
    if (!builder_.hasRoom(all, all, here(), diagnostics_)) return;
    if (!part_) part_ = &partOf();
    // The normal of a smoothing group at a position is the mean of its faces there by area; else each triangle has its own.
    const auto make = [&](Corner& corner, std::size_t row, const glm::dvec3& area) {
      if (row == made_.size()) made_.emplace_back(0);
      made_[row] += area;
      corner[2] = kMade + row;
    };
    for (const glm::dvec3 area = areaOf(places); Corner & each : corners)
      if (each[2] == kNoRow && group_ != 0)
        make(each, smooth_.try_emplace({each[0], group_, 0}, made_.size()).first->second, area);
    for (const auto& [a, b, c] : triangulate(places, work_))
      for (const std::size_t own = made_.size(); const std::size_t i : {a, b, c}) {
        Corner& corner = part_->corners.emplace_back(corners[i]);
        if (corner[2] == kNoRow) make(corner, own, areaOf(std::array{places[a], places[b], places[c]}));
      }
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
    RawMesh mesh{.name = model_.nodes[part.node].name, .normals = true};
    const glm::vec4 move = materials_.moveOf(part.material);
    if (std::ranges::any_of(part.corners, [](const Corner& each) { return each[1] == kNoRow; }))
      materials_.reportUvs(part.material, mesh.name);
    std::unordered_map<Corner, std::uint32_t, CornerHash> known;
    for (const Corner& corner : part.corners) {
      const auto [position, uv, normal] = corner;
      const auto row = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.indices.push_back(known.try_emplace(corner, row).first->second);
      if (mesh.indices.back() != row) continue;
      Vertex vertex{.position = positions_[position], .tangent = glm::vec4(0)};
      if (uv != kNoRow) vertex.uv = {uvs_[uv].x * move.x + move.z, 1 - (1 - uvs_[uv].y) * move.y - move.w};
      if (colored_ && !colorless_) mesh.colors.emplace_back(colors_[position], 1);
      vertex.normal = normal < kMade ? normals_[normal] : glm::vec3(glm::normalize(made_[normal - kMade]));
      mesh.vertices.push_back(vertex);
    }
    part.corners = {};
    model_.instances.push_back({part.node, builder_.add(std::move(mesh)), part.material, kNoRow});
  }

  ModelFiles& files_;
  Diagnostics& diagnostics_ = files_.diagnostics();
  Model& model_;
  MeshBuilder builder_{model_};
  MtlReader materials_{files_, model_};
  std::uint32_t line_ = 0;
  std::vector<glm::vec3> positions_, normals_, colors_;
  std::vector<glm::vec2> uvs_;
  bool colored_ = false, colorless_ = false;
  std::vector<glm::dvec3> made_;                                // normals
  std::unordered_map<Corner, std::size_t, CornerHash> smooth_;  // by position and smoothing group
  std::uint32_t node_ = kNoRow, material_ = 0, group_ = 0;
  std::map<std::string, std::uint32_t> nodes_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> partRows_;
  std::vector<Part> parts_;
  Part* part_ = nullptr;  // that faces go to
  std::size_t work_ = kWork;
  std::map<std::string, std::pair<std::uint32_t, unsigned>> leftOut_;  // the first line, and how many
};

}  // namespace

bool readObj(std::string_view bytes, ModelFiles& files, Model& model) {
  return files.isTextInLimit(bytes) && ObjReader(files, model).read(bytes);
}

}  // namespace weft::assets
