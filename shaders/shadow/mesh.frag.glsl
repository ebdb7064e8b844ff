// Depth alone, with the holes of masks.
// read    materials        @materials
//         material_maps?   @material_maps as linear wrap
// modify  depth            reversed-Z
#include "scene/materials.glsl"

in vec2 map_uv;
flat in uint row;

void main() {
  Material self = material[row];
  if (self.alpha_cutoff > 0.0 &&
      self.alpha * sampleMap(self.albedo_map, map_uv, dFdx(map_uv), dFdy(map_uv)).a < self.alpha_cutoff)
    discard;
}
