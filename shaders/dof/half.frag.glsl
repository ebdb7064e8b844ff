// The next coarser level of the two fields and of the discs: a 4 x 4 filter with the weights 1, 3, 3, 1, so that small
// things keep their exact position and there is no beat with the pixels that read it.
// read    near_source, far_source?, disc_source   a level, `as linear`
// write   near, far?, disc                        the next one, half as wide and high
uniform sampler2D near_source, disc_source;
#ifdef HAS_FAR_SOURCE
uniform sampler2D far_source;
#endif
out vec4 near;
#ifdef HAS_FAR
out vec4 far;
#endif
out vec2 disc;

void main() {
  vec2 texel = 1.0 / vec2(textureSize(disc_source, 0));
  vec3 sum = vec3(0.0);
  vec4 far_sum = vec4(0.0);
  near = vec4(0.0);
  for (int i = 0; i < 4; ++i) {
    vec2 at = (2.0 * gl_FragCoord.xy + vec2(i & 1, i >> 1) * 1.5 - 0.75) * texel, discs = textureLod(disc_source, at, 0.0).rg;
    near += 0.25 * textureLod(near_source, at, 0.0);
    sum.r += 0.25 * discs.r;
#if defined HAS_FAR && defined HAS_FAR_SOURCE
    // Coarse levels serve large discs. A surface with smaller ones beside those would mix with them, so it counts less.
    vec4 c = textureLod(far_source, at, 0.0);
    float weight = discs.g / max(c.a, 1e-4) + 1e-3;
    far_sum += weight * c;
    sum.gb += weight * vec2(discs.g, 1.0);
#endif
  }
#ifdef HAS_FAR
  far = far_sum / max(sum.b, 1e-9);
#endif
  disc = vec2(sum.r, sum.g / max(sum.b, 1e-9));
}
