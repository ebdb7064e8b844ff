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

vec4 meanOf(sampler2D source) {
  vec2 texel = 1.0 / vec2(textureSize(source, 0)), at = 2.0 * gl_FragCoord.xy * texel,
       low = at - 0.75 * texel, high = at + 0.75 * texel;
  return 0.25 * (textureLod(source, low, 0.0) + textureLod(source, high, 0.0) +
                 textureLod(source, vec2(low.x, high.y), 0.0) + textureLod(source, vec2(high.x, low.y), 0.0));
}

void main() {
  near = meanOf(near_source);
#if defined HAS_FAR && defined HAS_FAR_SOURCE
  far = meanOf(far_source);
#elif defined HAS_FAR
  far = vec4(0.0);
#endif
  disc = meanOf(disc_source).rg;
}
