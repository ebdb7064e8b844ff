// Lays the small discs over the picture.
// read    red_green, blue_alpha   from gather.comp.glsl
// modify  result   radiance, with "blend": "premultiplied"
uniform sampler2D red_green, blue_alpha;
out vec4 result;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  result = vec4(texelFetch(red_green, at, 0).rg, texelFetch(blue_alpha, at, 0).rg);
  // Half floats are not exact: what is added to this must not exceed the largest, 65504.
  result.rgb = min(result.rgb, vec3(65472.0) * result.a);
}
