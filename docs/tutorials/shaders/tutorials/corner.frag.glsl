// A picture with another in its upper right corner.
// read    picture   scene-referred, linear
// read    inset     the other
// write   result    for the screen
uniform sampler2D picture, inset;
in vec2 uv;
out vec4 result;

void main() {
  vec3 color = texelFetch(picture, ivec2(gl_FragCoord.xy), 0).rgb;
  vec2 at = (uv - 0.65) * 3.0;
  if (all(greaterThan(at, vec2(0.0))) && all(lessThan(at, vec2(1.0)))) color = textureLod(inset, at, 0.0).rgb;
  result = vec4(pow(color / (1.0 + color), vec3(1.0 / 2.2)), 1.0);
}
