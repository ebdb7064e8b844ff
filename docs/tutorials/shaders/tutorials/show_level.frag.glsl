// Shows a level of a chain, also one between two.
// read    chain    all levels
// write   result   for the screen
uniform sampler2D chain;
layout(std140) uniform Parameters { float level; };
in vec2 uv;
out vec4 result;

void main() {
  vec3 color = textureLod(chain, uv, level).rgb;
  result = vec4(pow(color / (1.0 + color), vec3(1.0 / 2.2)), 1.0);
}
