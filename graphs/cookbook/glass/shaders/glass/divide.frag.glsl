// The mean color of the surfaces, over what is behind. Blended premultiplied.
// read    sum, through
// modify  radiance
uniform sampler2D sum, through;
out vec4 radiance;

void main() {
  vec4 colors = texelFetch(sum, ivec2(gl_FragCoord.xy), 0);
  float covered = 1.0 - texelFetch(through, ivec2(gl_FragCoord.xy), 0).r;
  radiance = vec4(colors.rgb / max(colors.a, 1e-5) * covered, covered);
}
