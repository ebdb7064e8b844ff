// The mean over the frames, as far as the same surface was seen where it was.
// read    light, motion, surface; old_surface, old_mean, old_moments   of the frame before
// write   mean      rgb: light, a: number of frames
//         moments   means of brightness and of its square
uniform sampler2D light, motion, surface, old_surface, old_mean, old_moments;
layout(std140) uniform Parameters { float keep; };
in vec2 uv;
out vec4 mean;
out vec2 moments;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy), size = textureSize(light, 0);
  vec3 now = texelFetch(light, at, 0).rgb;
  float bright = dot(now, vec3(0.2126, 0.7152, 0.0722));
  vec4 self = texelFetch(surface, at, 0);

  // The four texels around the place, each only if it is of this surface.
  vec2 from = (uv - texelFetch(motion, at, 0).rg) * vec2(size) - 0.5, f = fract(from);
  vec4 sum = vec4(0.0);
  vec2 sum_moments = vec2(0.0);
  float weights = 0.0;
  for (int i = 0; i < 4; ++i) {
    ivec2 p = ivec2(floor(from)) + ivec2(i & 1, i >> 1);
    if (any(lessThan(p, ivec2(0))) || any(greaterThanEqual(p, size))) continue;
    vec4 other = texelFetch(old_surface, p, 0);
    bool same = self.w < 0.0 ? other.w < 0.0 : other.w > 0.0 && abs(other.w - self.w) < 0.05 * self.w && dot(other.xyz, self.xyz) > 0.9;
    float weight = same ? ((i & 1) == 1 ? f.x : 1.0 - f.x) * ((i >> 1) == 1 ? f.y : 1.0 - f.y) : 0.0;
    sum += weight * texelFetch(old_mean, p, 0);
    sum_moments += weight * texelFetch(old_moments, p, 0).rg;
    weights += weight;
  }
  if (weights < 0.01) {
    mean = vec4(now, 1.0);
    moments = vec2(bright, bright * bright);
    return;
  }
  sum /= weights;
  float count = min(sum.a + 1.0, keep);
  mean = vec4(mix(sum.rgb, now, 1.0 / count), count);
  moments = mix(sum_moments / weights, vec2(bright, bright * bright), 1.0 / count);
}
