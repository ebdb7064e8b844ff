// %NAME%: darkens the picture towards its edges. Replace this by what the pass shall do.
// read    source    the picture before this pass
// write   result    the picture after it
// params  strength  0: nothing changes, 1: the corners are black
uniform sampler2D source;
layout(std140) uniform Parameters {
  float strength;
};
in vec2 uv;  // (0,0) at the lower left, (1,1) at the upper right
out vec4 result;

void main() {
  vec4 color = texelFetch(source, ivec2(gl_FragCoord.xy), 0);
  vec2 from_center = uv - 0.5;
  result = vec4(color.rgb * (1.0 - strength * 2.0 * dot(from_center, from_center)), color.a);
}
