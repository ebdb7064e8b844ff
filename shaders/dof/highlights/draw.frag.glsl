// Draws highlights out of focus as discs or polygons at full size, and adds them to the picture. Scene-referred.
// read    highlights   from find
//         depth        reversed-Z, nearest
//         covering     the near field from near_fill, `as linear`: premultiplied
// modify  result       radiance, with "blend": "premultiplied"
// params  infinity, focus   as in split
//         tile, blades, grid   see highlights/parameters.glsl
#include "dof/coc.glsl"
#include "dof/far_field.glsl"
#include "parameters.glsl"

uniform sampler2D depth, covering;
out vec4 result;

const float kMost = 65504.0;  // the largest half float

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy), at = pixel / (tile * SCALE);
  float own = cocRadius(texelFetch(depth, pixel, 0).r, infinity, focus, 1e4);
  // The share of the far field that the near field does not cover.
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
      // A surface of the far field hides the discs behind it. It is nearer than a highlight when its own disc is smaller.
      float seen = highlight.radius < 0.0 ? 1.0 : own < 0.0 ? open : open * smoothstep(0.77, 0.91, own / highlight.radius);
      light += covered * seen * highlight.light.rgb;
    }
  }
  // Discs may overlap. In "premultiplied" the share that is taken of what is there keeps the sum within half floats; of dim light it is next to nothing.
  light = min(light, vec3(kMost));
  result = vec4(light, max(light.r, max(light.g, light.b)) / kMost);
}
