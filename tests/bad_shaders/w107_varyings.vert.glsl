flat out vec4 row[40];
void main() {
  for (int i = 0; i < 40; ++i) row[i] = vec4(i);
  gl_Position = vec4(0.0);
}
