// Column x of the picture is the x-th number of the parameters.
#define TAPS 5
layout(std140) uniform Parameters {
  float weights[TAPS];
  vec2 offsets[3];
  vec3 colors[2];
  mat3 turn;
  layout(row_major) mat2x3 oblong;
  int steps[4];
};
out float result;

void main() {
  int i = int(gl_FragCoord.x);
  if (i < 5) result = weights[i];
  else if (i < 11) result = offsets[(i - 5) / 2][(i - 5) % 2];
  else if (i < 17) result = colors[(i - 11) / 3][(i - 11) % 3];
  else if (i < 26) result = turn[(i - 17) / 3][(i - 17) % 3];
  else if (i < 32) result = oblong[(i - 26) / 3][(i - 26) % 3];
  else result = float(steps[i - 32]);
}
