// Which boxes are seen, and of these the ones that are not drawn yet.
// read    farthest   see culling/coarser.frag.glsl
//         before     state of each box in the frame before: those seen are drawn already
// write   state      0: out of view, 1: hidden, 2: seen
//         list       numbers of boxes
// modify  commands   a draw of them
//         counts     of each state
// define  CULL       0: nothing is hidden
#include "common/view.glsl"
#include "commands.glsl"
#include "town.glsl"
layout(local_size_x = 64) in;

uniform sampler2D farthest;
layout(std430) readonly buffer before { uint old_state[]; };
layout(std430) writeonly buffer state { uint new_state[]; };
layout(std430) buffer counts { uint count[3]; };
layout(std140) uniform Parameters { int blocks; vec2 size; };

uint stateOf(Box self) {
  // In the picture: a rectangle, and the depth of what is nearest.
  vec2 low = vec2(1e30), high = vec2(-1e30);
  float nearest = 0.0;
  bvec4 out_of = bvec4(true);
  bool behind = true, across = false;
  for (int k = 0; k < 8; ++k) {
    vec3 corner = vec3(k & 1, k >> 1 & 1, k >> 2) * 2.0 - 1.0;
    vec4 clip = view_projection * vec4(self.center + corner * self.half_size, 1.0);
    out_of = bvec4(out_of.x && clip.x < -clip.w, out_of.y && clip.x > clip.w, out_of.z && clip.y < -clip.w, out_of.w && clip.y > clip.w);
    behind = behind && clip.w < near_plane;
    across = across || clip.w < near_plane;
    vec3 p = clip.xyz / clip.w;
    low = min(low, p.xy);
    high = max(high, p.xy);
    nearest = max(nearest, p.z);
  }
  if (behind || any(out_of)) return 0u;
#if CULL
  if (!across) {
    // The level at which at most two by two cells hold the rectangle.
    ivec2 a = ivec2(clamp((low * 0.5 + 0.5) * size, vec2(0.0), size - 1.0)), b = ivec2(clamp((high * 0.5 + 0.5) * size, vec2(0.0), size - 1.0));
    int side = max(b.x - a.x, b.y - a.y), level = min(side < 1 ? 0 : findMSB(side) + 1, textureQueryLevels(farthest) - 1);
    ivec2 last = max(textureSize(farthest, 0) >> level, 1) - 1;
    a = min(a >> level, last);
    b = min(b >> level, last);
    float there = min(min(texelFetch(farthest, a, level).r, texelFetch(farthest, ivec2(b.x, a.y), level).r),
                      min(texelFetch(farthest, ivec2(a.x, b.y), level).r, texelFetch(farthest, b, level).r));
    // A little nearer, for what rounding does.
    if (nearest * 1.00001 < there) return 1u;
  }
#endif
  return 2u;
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i == 0u) indices = 36u;
  if (i >= uint(old_state.length())) return;
  uint now = stateOf(boxOf(i, blocks));
  new_state[i] = now;
  atomicAdd(count[now], 1u);
  if (now == 2u && old_state[i] != 2u) add(i);
}
