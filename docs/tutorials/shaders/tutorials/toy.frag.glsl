// A plasma, written as on Shadertoy.
// write   fragColor   for the screen
#include "shadertoy.glsl"

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
  vec2 p = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
  float rings = sin(8.0 * length(p) - 2.0 * iTime) + sin(5.0 * p.x + iTime) + sin(5.0 * p.y);
  fragColor = vec4(0.5 + 0.5 * cos(rings + vec3(0.0, 2.1, 4.2)), 1.0);
}
