// Two points of each instance, at one place.
void main() {
  gl_Position = vec4(0.0, 0.0, 0.5, 1.0);
  gl_PointSize = 1.0;
}
