// A plane across the view, of one radiance but for one square of another, which may lie elsewhere. A test picture.
// read    air?        see fog/sky.glsl
// write   radiance    scene-referred
//         velocity    screen UV per frame
//         depth       reversed-Z of a plane
// params  background  radiance of the plane
//         value       of the square
//         at, side    pixels: its lower left corner, and how long it is
//         distance    of the plane along the view axis, world units; 0: the sky
//         of_square   the square's; 0: as the plane
//         motion      pixels per frame
// defines BAD         one of BAD_NONE, BAD_NAN, BAD_INFINITE: what the square holds instead of `value`
#include "common/view.glsl"
#include "fog/sky.glsl"

layout(std140) uniform Parameters {
  float background;
  float value;
  vec2 at;
  int side;
  float distance;
  float of_square;
  vec2 motion;
};
out vec4 radiance;
#ifdef HAS_VELOCITY
out vec2 velocity;
#endif

void main() {
  vec2 from = floor(gl_FragCoord.xy) - at;
  bool inside = all(greaterThanEqual(from, vec2(0.0))) && all(lessThan(from, vec2(float(side))));
#if BAD == BAD_NAN
  float special = uintBitsToFloat(0x7fc00000u);
#elif BAD == BAD_INFINITE
  float special = uintBitsToFloat(0x7f800000u);
#else
  float special = value;
#endif
  vec3 light = vec3(inside ? special : background), ray = viewRay(gl_FragCoord.xy / viewport);
#ifdef HAS_AIR
  light = mix(fog_light.rgb, light, distance > 0.0 ? throughFog(ray * distance) : throughFogOfSky(ray));
#endif
  radiance = vec4(light, 1.0);
#ifdef HAS_VELOCITY
  velocity = motion / viewport;
#endif
#ifdef HAS_DEPTH
  float away = inside && of_square > 0.0 ? of_square : distance;
  gl_FragDepth = away > 0.0 ? near_plane / away : 0.0;
#endif
}
