// A constant, encoded as sRGB, exactly.
// write   result
// params  light   linear
layout(std140) uniform Parameters { vec3 light; };
out vec4 result;

void main() {
  result = vec4(mix(light * 12.92, 1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055, greaterThan(light, vec3(0.0031308))), 1.0);
}
