// The variance of the mean: over the frames, and over neighbors while there are few frames.
// read    mean       rgb: light, a: number of frames
//         moments, surface
// write   filtered   rgb: light, a: variance of its brightness
uniform sampler2D mean, moments, surface;
out vec4 filtered;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy), size = textureSize(mean, 0);
  vec4 self = texelFetch(mean, at, 0), place = texelFetch(surface, at, 0);
  vec2 both = texelFetch(moments, at, 0).rg;
  if (self.a < 4.0) {
    vec3 sum = vec3(both, 1.0);
    for (int y = -3; y <= 3; ++y)
      for (int x = -3; x <= 3; ++x) {
        ivec2 p = at + ivec2(x, y);
        if (any(lessThan(p, ivec2(0))) || any(greaterThanEqual(p, size)) || p == at) continue;
        vec4 other = texelFetch(surface, p, 0);
        float weight = abs(other.w - place.w) < 0.05 * abs(place.w) ? max(dot(other.xyz, place.xyz), 0.0) : 0.0;
        sum += weight * vec3(texelFetch(moments, p, 0).rg, 1.0);
      }
    both = sum.xy / sum.z;
  }
  filtered = vec4(self.rgb, max(both.y - both.x * both.x, 0.0) / max(self.a, 1.0));
}
