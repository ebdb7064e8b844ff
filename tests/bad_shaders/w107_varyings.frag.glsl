// 40 varyings: no device that Weft was tried on has more than 32.
flat in vec4 row[40];
out vec4 result;
void main() {
  result = vec4(0.0);
  for (int i = 0; i < 40; ++i) result += row[i];
}
