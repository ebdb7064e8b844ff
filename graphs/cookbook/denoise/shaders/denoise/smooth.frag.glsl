// A round of the à-trous filter (Dammertz and others 2010): 25 texels, twice as far apart in each round. What differs in brightness by
// much more than noise would, in distance or in normal, counts little.
// read    light      rgb: light, a: variance
//         surface    xyz: normal, w: distance
// write   filtered   as light
uniform sampler2D light, surface;
layout(std140) uniform Parameters { int round; };
out vec4 filtered;

const vec3 kWeights = vec3(0.375, 0.25, 0.0625);

float distanceAt(ivec2 p) { return texelFetch(surface, clamp(p, ivec2(0), textureSize(surface, 0) - 1), 0).w; }
float brightness(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy), size = textureSize(light, 0);
  vec4 self = texelFetch(light, at, 0), place = texelFetch(surface, at, 0);
  if (place.w < 0.0) {
    filtered = self;
    return;
  }
  int stride = 1 << (round - 1);
  // The variance of single texels is noise, too.
  float variance = 0.0;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x)
      variance += texelFetch(light, clamp(at + ivec2(x, y), ivec2(0), size - 1), 0).a / float((1 + abs(x)) * (1 + abs(y)) * 4);
  float spread = 4.0 * sqrt(max(variance, 0.0)) + 1e-4;

  // How much farther the surface is one texel on.
  vec2 slope = vec2(min(abs(distanceAt(at + ivec2(1, 0)) - place.w), abs(distanceAt(at - ivec2(1, 0)) - place.w)),
                    min(abs(distanceAt(at + ivec2(0, 1)) - place.w), abs(distanceAt(at - ivec2(0, 1)) - place.w)));
  vec4 sum = vec4(0.0);
  float weights = 0.0;
  for (int y = -2; y <= 2; ++y)
    for (int x = -2; x <= 2; ++x) {
      ivec2 p = at + stride * ivec2(x, y);
      if (any(lessThan(p, ivec2(0))) || any(greaterThanEqual(p, size))) continue;
      vec4 other = texelFetch(light, p, 0), there = texelFetch(surface, p, 0);
      if (there.w < 0.0) continue;
      float weight = kWeights[abs(x)] * kWeights[abs(y)] * pow(max(dot(there.xyz, place.xyz), 0.0), 16.0);
      float farther = dot(slope, vec2(abs(p - at))) + 0.005 * place.w;
      weight *= exp(-abs(there.w - place.w) / farther - abs(brightness(other.rgb) - brightness(self.rgb)) / spread);
      sum += vec4(weight * other.rgb, weight * weight * other.a);
      weights += weight;
    }
  filtered = vec4(sum.rgb / weights, sum.a / (weights * weights));
}
