// Walls with windows, fainter with distance.
// modify  result   encoded picture
#include "common/srgb.glsl"
#include "common/view.glsl"
#include "light.glsl"

in vec3 world;
flat in vec3 facing, color;
out vec4 result;

void main() {
  vec2 wall = vec2(abs(facing.x) > 0.5 ? world.z : world.x, world.y);
  vec2 pane = abs(fract(wall / vec2(0.8, 1.2)) - 0.5), wide = fwidth(wall);
  float glass = facing.y == 0.0 && world.y > 1.0 ? smoothstep(0.28, 0.22, pane.x) * smoothstep(0.32, 0.26, pane.y) / (1.0 + 9.0 * dot(wide, wide)) : 0.0;
  vec3 albedo = mix(color, vec3(0.08, 0.1, 0.14), glass);
  float sun = max(dot(facing, normalize(vec3(0.5, 0.7, 0.6))), 0.0);
  vec3 lit = albedo * (sun * vec3(1.0, 0.9, 0.75) + mix(0.25, 0.5, 0.5 + 0.5 * facing.y) * vec3(0.6, 0.7, 0.9));
  vec3 ray = world - eye;
  lit = mix(skyAt(normalize(ray * vec3(1.0, 0.0, 1.0))), lit, exp(-0.012 * length(ray)));
  result = vec4(encodeSrgb(clamp(lit, 0.0, 1.0)), 1.0);
}
