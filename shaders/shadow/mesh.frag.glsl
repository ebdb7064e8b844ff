// Depth alone, with the holes of masks.
// read    materials        @materials
//         material_maps?   @material_maps as linear wrap
//         vertex_colors?   @vertex_colors
//         thing_in_front?  see in_front.glsl: nothing else is drawn
// modify  depth            reversed-Z
#include "in_front.glsl"
#include "scene/materials.glsl"

in vec2 map_uv;
flat in uint row;
#ifdef HAS_VERTEX_COLORS
in float own_alpha;
#endif

void main() {
  if (isBehindAnother()) discard;
  Material self = material[row];
  float alpha = self.alpha;
#ifdef HAS_VERTEX_COLORS
  alpha *= own_alpha;
#endif
  if (self.alpha_cutoff > 0.0 &&
      alpha * sampleMap(self.albedo_map, map_uv, dFdx(map_uv), dFdy(map_uv)).a < self.alpha_cutoff)
    discard;
}
