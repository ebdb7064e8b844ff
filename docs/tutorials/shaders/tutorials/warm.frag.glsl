// Takes blue away and adds red.
// read    source   scene-referred, linear
// write   result   the same, warmer
uniform sampler2D source;
layout(std140) uniform Parameters { float warmth; };
in vec2 uv;
out vec4 result;

void main() {
  vec3 color = texelFetch(source, ivec2(gl_FragCoord.xy), 0).rgb;
  result = vec4(color * mix(vec3(1.0), vec3(1.6, 1.0, 0.4), warmth), 1.0);
}
