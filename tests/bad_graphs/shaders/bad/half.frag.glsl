// HLSL's type.
out vec4 result;

void main() {
  half bright = 0.5;
  result = vec4(bright);
}
