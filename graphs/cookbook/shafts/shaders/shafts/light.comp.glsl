// What the haze in a cell scatters towards the eye, and how much it takes away, both per meter.
// read    sun         the import @sun
//         mesh_maps   shadow maps, the sun's first
// write   haze        rgb: radiance, a: extinction
#include "common/view.glsl"
#include "scene/sun.glsl"
#include "cells.glsl"
layout(local_size_x = 8, local_size_y = 8, local_size_z = 1) in;

uniform sampler2DArrayShadow mesh_maps;
layout(rgba16f) uniform writeonly image3D haze;
layout(std140) uniform Parameters { float density; float height; float far; float forward; };

void main() {
  ivec3 cell = ivec3(gl_GlobalInvocationID), size = imageSize(haze);
  if (any(greaterThanEqual(cell, size))) return;
  vec3 ray = viewRay((vec2(cell.xy) + 0.5) / vec2(size.xy));
  vec3 at = eye + ray * far * layerStart(float(cell.z) + 0.5, float(size.z));
  float extinction = density * exp(-max(at.y, 0.0) / height);

  Sun light = sun_light[0];
  vec3 on_map = (light.shadow_matrix * vec4(at, 1.0)).xyz;
  bool inside = all(greaterThan(on_map, vec3(0.0))) && all(lessThan(on_map, vec3(1.0)));
  float lit = inside ? texture(mesh_maps, vec4(on_map.xy, 0.0, on_map.z)) : 1.0;
  // Henyey and Greenstein 1941.
  float mu = dot(normalize(ray), light.direction), g = forward;
  float phase = (1.0 - g * g) / (12.566 * pow(1.0 + g * g - 2.0 * g * mu, 1.5));
  vec3 scattered = extinction * light.irradiance * (lit * phase + 0.01);
  imageStore(haze, cell, vec4(scattered, extinction));
}
