// modify  sum       rgb: color times opacity, a: opacity, both by weight (equation 8 of the paper); added
//         through   1 - opacity; multiplied
#include "surface.glsl"

out vec4 sum;
out float through;

void main() {
  vec4 shell = shell();
  float z = distance(eye, world);
  sum = shell * clamp(0.03 / (1e-5 + pow(z / 20.0, 4.0)), 0.01, 3000.0);
  through = 1.0 - shell.a;
}
