// Motion blur over an open shutter, centred on the frame, in the tiles that gather.vert.glsl picks. Scene-referred.
// read    source     a copy of the radiance; all textures by any sampler (texels are fetched)
//         velocity   screen UV per frame
//         depth      reversed-Z, 0 is the sky, which is blurred like everything else
//         tiles      from neighbour_max
// modify  result     radiance; alpha stays
// params  shutter    degrees: 360 is open all the time between two frames
//         samples    per line at most; short streaks take one per pixel
//         tile       pixels along a tile's side; also limits the blur
//
// Tiles after McGuire et al. (I3D 2012); weights after Jimenez ("Next generation post processing in Call of Duty", SIGGRAPH
// 2014). A nearer texel counts where its own streak reaches, and the less, the longer the streak is. The sum is divided by the
// number of all samples, not of those found, so that light is neither made nor lost. The pixel's own layer lies underneath,
// blurred along its own velocity over texels that are not nearer: what a moving thing hides is filled in from beside it.
#include "common/finite.glsl"
#include "blur.glsl"

uniform sampler2D source, velocity, depth, tiles;
layout(std140) uniform Parameters {
  float shutter;
  int samples;
  int tile;
};
out vec4 result;

const float kThickness = 0.05;  // a texel nearer by this share of the distance counts wholly as nearer
const float kOwn = 1e-3;        // weight of the pixel itself, for pixels whose layer no sample belongs to

// 1 where the texel is nearer than the pixel, 0 where not.
float nearer(float there, float here) { return clamp((there - here) / max(kThickness * there, 1e-20), 0.0, 1.0); }

// Does a streak of `half_length` reach `distance`? Integrates to twice the half length over a line.
float reach(float half_length, float distance) { return clamp(half_length - distance + 0.5, 0.0, 1.0); }

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  ivec2 size = textureSize(source, 0);
  vec4 own = texelFetch(source, pixel, 0);
  vec2 longest = streakOf(texelFetch(tiles, pixel / tile, 0).rg, vec2(size), shutter, tile);
  float far_reach = length(longest);
  vec2 streak = streakOf(texelFetch(velocity, pixel, 0).rg, vec2(size), shutter, tile);
  float own_reach = length(streak);
  float own_depth = texelFetch(depth, pixel, 0).r;
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  // Both lines at once when they are nearly one.
  bool two_lines = own_reach >= 0.25 && distance(longest, streak) > 0.1 * far_reach + 0.5;

  vec2 along = longest / far_reach;
  float span = far_reach + 0.5;
  vec3 front = vec3(0.0), under = finite(own.rgb) * kOwn;
  float front_weight = 0.0, under_weight = kOwn;
  int n = min(samples, int(ceil(2.0 * span)));
  for (int i = 0; i < n; ++i) {
    float t = ((float(i) + noise) / float(n) * 2.0 - 1.0) * span;
    ivec2 at = clamp(ivec2(floor(gl_FragCoord.xy + along * t)), ivec2(0), size - 1);
    float in_front = nearer(texelFetch(depth, at, 0).r, own_depth);
    vec3 c = finite(texelFetch(source, at, 0).rgb);
    float spread = abs(dot(streakOf(texelFetch(velocity, at, 0).rg, vec2(size), shutter, tile), along));
    float w = in_front * reach(spread, abs(t)) * span / max(spread, 0.5);
    front += w * c;
    front_weight += w;
    if (!two_lines) {
      w = (1.0 - in_front) * reach(own_reach, abs(t));
      under += w * c;
      under_weight += w;
    }
  }
  if (two_lines) {
    along = streak / own_reach;
    for (int i = 0; i < n; ++i) {
      float t = ((float(i) + noise) / float(n) * 2.0 - 1.0) * own_reach;
      ivec2 at = clamp(ivec2(floor(gl_FragCoord.xy + along * t)), ivec2(0), size - 1);
      float w = 1.0 - nearer(texelFetch(depth, at, 0).r, own_depth);
      under += w * finite(texelFetch(source, at, 0).rgb);
      under_weight += w;
    }
  }
  under /= under_weight;
  float cover = min(front_weight / float(n), 1.0);
  result = vec4(front_weight > 0.0 ? mix(under, front / front_weight, cover) : under, own.a);
}
