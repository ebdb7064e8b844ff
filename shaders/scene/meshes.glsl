// The rows of the meshes of a draw list, filled by the engine (bound by the name of the block). A vertex shader of geometry
// `mesh` has the attributes position, normal, tangent (w: sign of the bitangent), uv, joints, weights, and `instance`, its row.
#ifndef SCENE_MESHES_GLSL
#define SCENE_MESHES_GLSL

struct MeshRow {
  mat4 transform;           // model to world; of a skinned mesh the identity
  mat4 previous_transform;  // of the frame before
  uint material;            // row of @materials
  uint first_joint;         // row of @joints, of a mesh with weights
#ifdef HAS_MORPH_TARGETS
  uint first_weight;        // row of @morph_weights, of a mesh with targets
  uint first_target;        // row of @morph_targets, for vertex 0
  uint targets;             // of each vertex, one after another; 0: nothing morphs it
#endif
};
layout(std430) readonly buffer instances { MeshRow mesh_row[]; };

#endif
