// Writes seed and the place; adds 1 where it was.
layout(std140) uniform Parameters { float seed; };
out vec4 result;
out vec4 marks;

void main() {
  result = vec4(seed, gl_FragCoord.xy, 1.0);
  marks = vec4(1.0);
}
