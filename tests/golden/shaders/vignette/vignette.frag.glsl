// Darkens the picture towards its corners, like a lens. Scene-referred: before the tone curve.
// read    source   radiance; any sampler
// write   result   radiance
// params  stops    how much darker the corners are, in stops
uniform sampler2D source;
layout(std140) uniform Parameters { float stops; };
in vec2 uv;
out vec4 result;

void main() {
  vec2 from_center = (uv - 0.5) * 2.0;
  vec3 color = texelFetch(source, ivec2(gl_FragCoord.xy), 0).rgb;
  result = vec4(color * exp2(-stops * 0.5 * dot(from_center, from_center)), 1.0);
}
