// Removes the light of the highlights from the fields, because draw.frag.glsl draws it. The alpha of the fields stays, so their coverage
// does not change.
// read    highlights   from find
// modify  near, far    from split
// params  grid         tiles
layout(local_size_x = 8, local_size_y = 8) in;
#include "list.glsl"

layout(std430) readonly buffer highlights { TileHighlights lists[]; };
layout(rgba16f) uniform image2D near;
layout(rgba16f) uniform image2D far;
layout(std140) uniform Parameters { ivec2 grid; };

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(at, grid))) return;
  int list = at.y * grid.x + at.x, count = int(lists[list].count.x);
  for (int i = 0; i < count; ++i) {
    Highlight highlight = lists[list].of[i];
    ivec2 texel = ivec2(highlight.middle) / SCALE;
    vec4 left = vec4(vec3(1.0 - highlight.share), 1.0);
    if (highlight.radius < 0.0)
      imageStore(near, texel, imageLoad(near, texel) * left);
    else
      imageStore(far, texel, imageLoad(far, texel) * left);
  }
}
