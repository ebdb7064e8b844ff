// Highlights out of focus, as discs or polygons at full size, added to the picture. Scene-referred.
// read    highlights   from find
//         depth        reversed-Z, nearest
//         covering     the near field from near_fill, `as linear`: premultiplied
// modify  result       radiance, with "blend": "add"
// params  infinity, focus   as in split
//         tile         texels of the fields along a tile's side
//         blades       of the aperture
//         grid         tiles
#include "dof/coc.glsl"
#include "dof/far_field.glsl"
#include "list.glsl"

uniform sampler2D depth, covering;
layout(std430) readonly buffer highlights { TileHighlights lists[]; };
layout(std140) uniform Parameters {
  float infinity;
  float focus;
  int tile;
  int blades;
  ivec2 grid;
};
out vec4 result;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy), at = pixel / (tile * SCALE);
  float own = cocRadius(texelFetch(depth, pixel, 0).r, infinity, focus, 1e4);
  // Of the far field, what the near field leaves.
  float open = 1.0 - min(textureLod(covering, gl_FragCoord.xy / float(SCALE) / vec2(textureSize(covering, 0)), 0.0).a, 1.0);
  open *= own < 0.0 ? smoothstep(kNearStart, 3.0, -own) : 1.0;
  vec3 light = vec3(0.0);
  for (int i = 0; i < 9; ++i) {
    ivec2 there = at + ivec2(i % 3, i / 3) - 1;
    bool inside = there == clamp(there, ivec2(0), grid - 1);
    int list = inside ? there.y * grid.x + there.x : 0, count = inside ? int(lists[list].count.x) : 0;
    for (int k = 0; k < count; ++k) {
      Highlight highlight = lists[list].of[k];
      float covered = coveredBy(highlight.radius, highlight.light.a, gl_FragCoord.xy - highlight.middle, blades);
      // Behind what is nearer and in the far field too, a disc is hidden.
      float seen = highlight.radius < 0.0 ? 1.0 : own < 0.0 ? open : open * smoothstep(0.77, 0.91, own / highlight.radius);
      light += covered * seen * highlight.light.rgb;
    }
  }
  result = vec4(light, 0.0);
}
