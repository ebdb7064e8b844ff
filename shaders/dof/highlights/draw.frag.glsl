// Draws highlights out of focus as discs or polygons at full size, and adds them to the picture. Scene-referred.
// read    highlights   from find
//         depth        reversed-Z, nearest
//         covering     the near field from near_fill, `as linear`: premultiplied
// modify  result       radiance, with "blend": "premultiplied"
// params  infinity, focus   as in split
//         tile, blades, grid   see highlights/parameters.glsl
#include "dof/coc.glsl"
#include "parameters.glsl"

uniform sampler2D depth, covering;
out vec4 result;

const float kMost = 65504.0;  // the largest half float

// Radius of the disc of each of the four pixels around `at`, in the order of textureGather; negative in the near field.
vec4 radiiAround(vec2 at) {
  vec4 depths = textureGather(depth, at / viewport);
  return infinity - (infinity * focus / near_plane) * depths;
}

// The share of a highlight's light to this pixel that passes nearer surfaces. It comes through one place of the lens. At the depth where
// discs have the radius r, its path projects to `middle` + (pixel - middle) (1 - r / radius); a surface hides it when that place has this
// depth. `nearest`: radius of the largest disc of the near field that may do so.
float passing(vec2 middle, float radius, float nearest) {
  vec2 way = gl_FragCoord.xy - middle;
  float size = abs(radius), first = radius < 0.0 ? -1.15 * size : 0.85 * size, last = -nearest;
  float step_size = min(0.12 * size, 1.5);
  int steps = min(int(ceil((first - last) / step_size)), 64);
  float seen = 1.0;
  for (int i = 0; i <= steps && seen > 0.0; ++i) {
    float there = first - step_size * float(i);
    vec2 at = middle + way * (1.0 - there / radius);
    if (any(notEqual(at, clamp(at, vec2(0.0), viewport)))) continue;
    float scene = infinity - (infinity * focus / near_plane) * texelFetch(depth, min(ivec2(at), ivec2(viewport) - 1), 0).r;
    if (abs(scene - there) > step_size || scene > first) continue;
    // As exact as the pixels are: here the path is at the depth that was found.
    at = middle + way * (1.0 - scene / radius);
    vec4 hit = step(abs(radiiAround(at) - scene), vec4(step_size));
    vec2 part = fract(at - 0.5);
    // Depth has a whole pixel where a surface covers any part of it: on average it ends half a pixel too far out.
    seen = min(seen, 2.0 - 2.0 * mix(mix(hit.w, hit.z, part.x), mix(hit.x, hit.y, part.x), part.y));
  }
  return seen;
}

// The part of a highlight's light that is drawn here; small/gather.comp.glsl has gathered the rest, on the highlight's own surface as if its
// disc were that of the pixel.
float shareAt(float own, float radius) {
  return fieldShare(mix(radius, own, 1.0 - nearerBy(max(own, radius), min(own, radius))));
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy), at = pixel / (tile * SCALE);
  float own = cocRadius(texelFetch(depth, pixel, 0).r, infinity, focus, 1e4);
  // The share of the far field that the near field does not cover.
  float open = 1.0 - min(textureLod(covering, gl_FragCoord.xy / float(SCALE) / vec2(textureSize(covering, 0)), 0.0).a, 1.0);
  open *= own < 0.0 ? fieldShare(own) : 1.0;
  vec3 light = vec3(0.0), drawn = vec3(0.0);
  for (int i = 0; i < 9; ++i) {
    ivec2 there = at + ivec2(i % 3, i / 3) - 1;
    bool inside = there == clamp(there, ivec2(0), grid - 1);
    int list = inside ? there.y * grid.x + there.x : 0, count = inside ? int(lists[list].count.x) : 0;
    for (int k = 0; k < count; ++k) {
      Highlight highlight = lists[list].of[k];
      float covered = coveredBy(highlight.radius, abs(highlight.light.a), gl_FragCoord.xy - highlight.middle, blades);
      // A surface of the far field hides the discs behind it. It is nearer than a highlight when its own disc is smaller.
      float seen = highlight.radius < 0.0 ? 1.0 : own < 0.0 ? open : open * smoothstep(0.77, 0.91, own / highlight.radius);
      if (covered > 0.0 && highlight.light.a < 0.0) seen = passing(highlight.middle, highlight.radius, lists[list].count.y);
      light += covered * seen * highlight.light.rgb;
      drawn += covered * seen * shareAt(own, highlight.radius) * highlight.light.rgb;
    }
  }
  // Discs may overlap. Where their sum comes near the largest half float, "premultiplied" removes a share of the destination, so that the
  // sum stays below it. Dimmer discs only add. What small/gather.comp.glsl has gathered leaves room for the part that is drawn.
  float full = min(max(light.r, max(light.g, light.b)) / kMost, 1.0);
  drawn *= min(vec3(kMost) / max(light, vec3(1e-4)), vec3(1.0));
  float part = max(drawn.r, max(drawn.g, drawn.b)) / kMost;
  result = vec4(drawn, part * part / max(full, 1e-4) * smoothstep(0.1, 0.3, full));
}
