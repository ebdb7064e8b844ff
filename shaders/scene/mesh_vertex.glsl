// A vertex of a mesh in the world, now and in the frame before: morphed, and by its row, or by its joints; and its color. Slots:
// skeleton? (@joints), morph_targets? (@morph_targets), morph_weights? (@morph_weights), vertex_colors? (@vertex_colors),
// second_uvs? (@second_uvs).
#ifndef SCENE_MESH_VERTEX_GLSL
#define SCENE_MESH_VERTEX_GLSL
#include "scene/meshes.glsl"

in vec3 position;
in uint instance;
#ifdef HAS_SKELETON
in uvec4 joints;
in vec4 weights;
struct Joint {
  mat4 now, previous;  // bind pose to world
};
layout(std430) readonly buffer skeleton { Joint joint[]; };
#endif

struct MorphTarget {
  vec3 position, normal, tangent;  // that a weight of 1 adds
};
#ifdef HAS_MORPH_TARGETS
layout(std430) readonly buffer morph_targets { MorphTarget morph_target[]; };
#endif
#ifdef HAS_MORPH_WEIGHTS
struct MorphWeight {
  vec2 weight;  // in this frame, in the one before
};
layout(std430) readonly buffer morph_weights { MorphWeight morph_weight[]; };
#endif

#ifdef HAS_VERTEX_COLORS
struct VertexColor {
  vec4 color;  // linear; a factor of the material's albedo and alpha
};
layout(std430) readonly buffer vertex_colors { VertexColor vertex_color[]; };
#endif
#ifdef HAS_SECOND_UVS
struct SecondUv {
  vec2 uv;  // of maps that say so: scene/materials.glsl
};
layout(std430) readonly buffer second_uvs { SecondUv second_uv[]; };
#endif

// What morph targets add to this vertex in its mesh.
MorphTarget morphed(bool before) {
  MorphTarget sum = MorphTarget(vec3(0.0), vec3(0.0), vec3(0.0));
#if defined(HAS_MORPH_TARGETS) && defined(HAS_MORPH_WEIGHTS)
  MeshRow row = mesh_row[instance];
  for (uint t = 0u; t < row.targets; ++t) {
    MorphTarget target = morph_target[row.first_target + uint(gl_VertexID) * row.targets + t];
    vec2 weights = morph_weight[row.first_weight + t].weight;
    float weight = before ? weights.y : weights.x;
    sum.position += weight * target.position;
    sum.normal += weight * target.normal;
    sum.tangent += weight * target.tangent;
  }
#endif
  return sum;
}

// Where the vertex is in its mesh, now and in the frame before.
vec4 meshPosition() { return vec4(position + morphed(false).position, 1.0); }
vec4 meshPreviousPosition() { return vec4(position + morphed(true).position, 1.0); }

// Model to world of this vertex.
mat4 meshTransform() {
#ifdef HAS_SKELETON
  if (weights.x > 0.0) {
    mat4 sum = mat4(0.0);
    for (int i = 0; i < 4; ++i) sum += weights[i] * joint[mesh_row[instance].first_joint + joints[i]].now;
    return sum;
  }
#endif
  return mesh_row[instance].transform;
}

mat4 meshPreviousTransform() {
#ifdef HAS_SKELETON
  if (weights.x > 0.0) {
    mat4 sum = mat4(0.0);
    for (int i = 0; i < 4; ++i) sum += weights[i] * joint[mesh_row[instance].first_joint + joints[i]].previous;
    return sum;
  }
#endif
  return mesh_row[instance].previous_transform;
}

// Of a direction that is perpendicular to a surface, in the model. One that morph targets have taken away becomes the z axis.
vec3 meshNormal(mat4 transform, vec3 direction) {
  mat3 m = mat3(transform);
  if (dot(direction, direction) == 0.0) direction = vec3(0.0, 0.0, 1.0);
  // The cofactors: the inverse transposed, times the determinant; no division, and right for scales of zero.
  return normalize(mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])) * direction * sign(determinant(m)));
}

#endif
