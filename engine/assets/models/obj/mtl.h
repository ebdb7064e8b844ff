// The materials of an OBJ file. Internal to the folder.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "engine/assets/models/parts/model_files.h"
#include "engine/assets/models/parts/texture_pool.h"

namespace weft::assets {

class MtlReader {
 public:
  // Row 0 of Model::materials is that of faces without one.
  MtlReader(ModelFiles& files, text::Diagnostics& diagnostics, Model& model);

  // What `mtllib` says: a file, or several.
  void readLibraries(const std::string& names, const text::Place& place);
  // What `usemtl` says; row 0 and W168 for a name that no library has, unless one is missing.
  std::uint32_t rowOf(const std::string& name, const text::Place& place);
  // How texture coordinates of a material are moved, v upwards: scale in xy, offset in zw.
  glm::vec4 moveOf(std::uint32_t material) const { return moves_[material]; }
  // Decodes the maps. False when `observer` gave up, or after errors.
  bool finish(const LoadObserver& observer);

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
    text::Place place;
    std::map<std::string, Map, std::less<>> maps;  // by what they are of: "Kd"
    bool physical = false;                         // it has Pr or Pm
  };
  void readLibrary(const std::string& name, const text::Place& place);
  void readStatement(std::string_view rest, const text::Place& place);
  void readMap(const std::string& of, std::string_view rest, const text::Place& place);
  void finishRow(std::size_t number);
  void leaveOut(const std::string& what, const text::Place& place);

  ModelFiles& files_;
  text::Diagnostics& diagnostics_;
  Model& model_;
  TexturePool pool_;
  std::vector<Row> rows_;  // parallel to the materials of the model
  std::vector<glm::vec4> moves_;
  std::map<std::string, std::uint32_t> known_, images_;
  std::set<std::string> said_, libraries_;
  bool missing_ = false;  // a library
};

}  // namespace weft::assets
