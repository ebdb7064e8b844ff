// Lays the small discs over the picture, below the near field.
// read    red_green, blue_alpha   from gather.comp.glsl
//         source   own texel of what `result` modifies, with "feedback"
//         depth    reversed-Z
//         near, discs   from split
//         blurred  the near field, `as linear`
// modify  result   radiance; alpha stays
// params  infinity, focus   as in split
#include "common/finite.glsl"
#include "dof/coc.glsl"

uniform sampler2D red_green, blue_alpha, source, depth, near, discs, blurred;
layout(std140) uniform Parameters {
  float infinity;
  float focus;
};
out vec4 result;

// What the near field leaves to the small discs of the own surface: together they have all of it. `own`: radius of the pixel's disc.
float leftToSmall(float own) {
  vec2 at = gl_FragCoord.xy / float(SCALE), corner = round(at), texel = 1.0 / vec2(textureSize(near, 0)), f = at + 0.5 - corner;
  vec4 shares = textureGather(near, corner * texel, 3);
  vec4 radii = float(SCALE) * textureGather(discs, corner * texel, 0) / max(shares, vec4(0.25));
  vec4 weights = vec4(1.0 - f.x, f.x, f.x, 1.0 - f.x) * vec4(f.y, f.y, 1.0 - f.y, 1.0 - f.y) * vec4(greaterThan(shares, vec4(0.0)));
  float sum = dot(weights, vec4(1.0)), in_fields = sum > 0.0 ? dot(weights, smoothstep(kSmall, kLarge, radii)) / sum : fieldShare(own);
  float open = 1.0 - textureLod(blurred, at * texel, 0.0).a;
  return in_fields < 1.0 ? clamp((1.0 - in_fields) / max(open, 1e-4), 0.0, 1.0) : 0.0;
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec4 own = texelFetch(source, at, 0), small = vec4(texelFetch(red_green, at, 0).rg, texelFetch(blue_alpha, at, 0).rg);
  float radius = cocRadius(texelFetch(depth, at, 0).r, infinity, focus, 1e4);
  small *= radius < -kSmall ? leftToSmall(radius) : 1.0;
  result = vec4(small.rgb + (1.0 - small.a) * finite(own.rgb), own.a);
}
