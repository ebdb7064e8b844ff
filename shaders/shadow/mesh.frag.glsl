// Depth alone, with the holes of masks.
// read    materials        @materials
//         material_maps?   @material_maps as linear wrap
//         vertex_colors?   @vertex_colors
//         thing_in_front?  as meshes/forward.frag.glsl writes it: nothing else is drawn
// modify  depth            reversed-Z
#include "scene/materials.glsl"

in vec2 map_uv;
flat in uint row;
#ifdef HAS_VERTEX_COLORS
in float own_alpha;
#endif

#ifdef HAS_THING_IN_FRONT
uniform usampler2D thing_in_front;
flat in uint thing;
#endif

void main() {
#ifdef HAS_THING_IN_FRONT
  if (texelFetch(thing_in_front, ivec2(gl_FragCoord.xy), 0).r != thing) discard;
#endif
  Material self = material[row];
  float alpha = self.alpha;
#ifdef HAS_VERTEX_COLORS
  alpha *= own_alpha;
#endif
  if (self.alpha_cutoff > 0.0 &&
      alpha * sampleMap(self.albedo_map, map_uv, dFdx(map_uv), dFdy(map_uv)).a < self.alpha_cutoff)
    discard;
}
