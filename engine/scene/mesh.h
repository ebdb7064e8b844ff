// The rows of Scene::meshes, which are ranges of Scene::meshData.
#pragma once

#include "engine/assets/model.h"
#include "engine/scene/table.h"

namespace weft::scene {

using assets::Box;
using assets::Mesh;
using assets::MeshData;
using assets::SkinVertex;
using assets::Vertex;
using MeshId = Table<Mesh>::Id;

}  // namespace weft::scene
