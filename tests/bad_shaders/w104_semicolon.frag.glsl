out vec4 result;

void main() {
  vec3 color = vec3(0.5)
  result = vec4(color, 1.0);
}
