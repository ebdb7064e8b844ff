// write   floats, depth, naturals, wholes   1, 2, 3, 4 from left to right; depth and floats a quarter of that
out float floats;
out uint naturals;
out int wholes;

void main() {
  int number = int(gl_FragCoord.x) + 1;
  floats = 0.25 * float(number);
  naturals = uint(number);
  wholes = -number;
  gl_FragDepth = 0.25 * float(number);
}
