// Models of tests: loaded without an error, and where their nodes stand.
#pragma once

#include <doctest/doctest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <utility>

#include "engine/assets/models/model_file.h"
#include "tests/assets/models/gltf_maker.h"
#include "tests/temporary_folder.h"

namespace weft::test {

// Of the models that come with Weft.
inline const std::string kModels = WEFT_SOURCE_DIR "/scenes/models/";

inline assets::Model loadGood(const std::string& path, std::size_t warnings = 0) {
  text::Diagnostics diagnostics;
  auto model = assets::loadModel(path, diagnostics);
  REQUIRE_MESSAGE(model, diagnostics.text());
  CHECK_MESSAGE(diagnostics.size() == warnings, diagnostics.text());
  return std::move(*model);
}

inline assets::Model make(const GltfMaker& maker, std::size_t warnings = 0) {
  const TemporaryFolder folder;
  return loadGood(folder.write("m.gltf", maker.gltf()), warnings);
}

inline glm::mat4 matrixOf(const assets::ModelNode& node) {
  const assets::Transform& local = node.local;
  return glm::translate(glm::mat4(1), local.translation) * glm::mat4_cast(local.rotation) *
         glm::scale(glm::mat4(1), local.scale) * glm::mat4(node.inner);
}

inline glm::mat4 worldOf(const assets::Model& model, std::uint32_t node) {
  glm::mat4 world = matrixOf(model.nodes[node]);
  for (std::uint32_t up = model.nodes[node].parent; up != assets::kNoRow; up = model.nodes[up].parent)
    world = matrixOf(model.nodes[up]) * world;
  return world;
}

}  // namespace weft::test
