// The key `models` of a scene file: files read by engine/assets/models/model_file.h, placed, copied, moved and animated. A
// file that several entries name is read once. What is wrong is W160, W161, W162, W169, W168 (a
// second sun), or what reading the model reports.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/assets/loading/load_observer.h"
#include "engine/scene/files/reading.h"
#include "engine/scene/models/add_model.h"
#include "engine/scene/scene.h"
#include "engine/text/diagnostic.h"

namespace weft::scene {

constexpr std::size_t kMaxNodes = std::size_t{1} << 21;

class SceneModels {
 public:
  // A material of the scene by name, or null after an error.
  using FindMaterial = std::function<MaterialId(const text::JsonValue& value, const std::string& what)>;

  // `sceneFile`: paths are relative to it. All must outlive this.
  SceneModels(Scene& scene, const std::string& sceneFile, text::Diagnostics& diagnostics,
              const assets::LoadObserver& observer)
      : scene_(scene), sceneFile_(sceneFile), diagnostics_(diagnostics), observer_(observer) {}

  void read(SceneFields& fields, const FindMaterial& findMaterial);
  // One model at its own coordinates, with its first animation. False after errors.
  bool addWhole(const std::string& path);
  // Puts the vertices into the scene: once everything is read.
  void finish();

  // Whether a model is missing from the scene: after errors, or because the observer gave up.
  bool failed() const { return failed_; }
  // Everything that the models read or should have read.
  const std::vector<std::string>& files() const { return files_; }

 private:
  struct Loaded {
    assets::Model model;
    ModelRows rows;
  };
  const Loaded* load(const std::string& path);
  void readModel(const std::string& name, const text::JsonValue& value, const FindMaterial& findMaterial);
  void readAnimation(const text::JsonValue& value, const std::string& what, const assets::Model& model,
                     ModelCopy& copy);
  void addCopies(const text::JsonValue& value, const std::string& name, const Loaded& loaded, ModelCopy copy,
                 const SceneGrid& grid);

  Scene& scene_;
  const std::string& sceneFile_;
  text::Diagnostics& diagnostics_;
  const assets::LoadObserver& observer_;
  std::map<std::string, std::unique_ptr<Loaded>> loaded_;  // by path; null: it failed
  std::shared_ptr<MeshData> data_ = std::make_shared<MeshData>();
  std::vector<std::string> files_;
  std::string sunOf_;  // the model that gave the scene its sun
  bool failed_ = false;
};

// A model file as a scene: the model at its own coordinates with its first animation, cameras that frame its box (`front`,
// `left`, `right`, `back`, `top`), and its lights; a sun where it has none. `files`, when given, is set to everything that was read
// or should have been, also after errors.
std::optional<Scene> loadModelScene(const std::string& path, text::Diagnostics& diagnostics,
                                    std::vector<std::string>* files, const assets::LoadObserver& observer);

}  // namespace weft::scene
