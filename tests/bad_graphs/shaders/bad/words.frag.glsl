// Sound, with names of every kind, for graphs that take one for another.
uniform sampler2D source;
layout(std140) uniform Parameters { float gain; };
in vec2 uv;
out vec4 result;

const float strength = 0.5;

vec4 tone(vec4 color) { return color / (1.0 + color); }

void main() {
  vec4 texel = texture(source, uv);
  result = tone(texel * gain * strength);
}
