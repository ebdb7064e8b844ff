out vec3 uv;
void main() {
  uv = vec3(0);
  gl_Position = vec4(0, 0, 0, 1);
}
