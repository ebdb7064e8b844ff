// More contrast to the four neighbors, as far as no value leaves their range.
// read    source   encoded picture
// write   result   encoded picture
uniform sampler2D source;
layout(std140) uniform Parameters { float amount; };
out vec4 result;

vec3 at(ivec2 p) { return texelFetch(source, clamp(p, ivec2(0), textureSize(source, 0) - 1), 0).rgb; }

void main() {
  ivec2 p = ivec2(gl_FragCoord.xy);
  vec3 here = at(p), a = at(p + ivec2(1, 0)), b = at(p - ivec2(1, 0)), c = at(p + ivec2(0, 1)), d = at(p - ivec2(0, 1));
  vec3 low = min(min(min(a, b), min(c, d)), here), high = max(max(max(a, b), max(c, d)), here);
  result = vec4(clamp(here + amount * (here - 0.25 * (a + b + c + d)), low, high), 1.0);
}
