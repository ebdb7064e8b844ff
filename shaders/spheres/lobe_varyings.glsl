// What the vertex shader of a sphere finds out once about its reflections, of spots the first, packed into eight vectors: OpenGL promises
// 15 in all. In software an input costs less than a member of a block, so values that are the same for all spheres are inputs, too.
// define  VERTEX_STAGE   in the vertex shader, which calls writeLobe(); fragments call readLobe() and readGlint()
#ifndef SPHERES_LOBE_VARYINGS_GLSL
#define SPHERES_LOBE_VARYINGS_GLSL

#include "shading/environment.glsl"
#include "spheres/glint.glsl"

#ifdef VERTEX_STAGE
#define VARYING flat out
#else
#define VARYING flat in
#endif

VARYING vec4 lobe_levels;  // environment_level, specular_level, specular_weight, level_per_shift
VARYING vec4 lobe_shape;   // of the spot: alpha2, tail, bump, per_core
VARYING vec4 lobe_spot;    // spot; specular_pole
VARYING vec4 lobe_light;   // spot_light; irradiance_pole
VARYING vec4 lobe_cut;     // spot_limit, spot_cut; where the glint is
VARYING vec4 lobe_glint;   // falloff, middle, strength; environment_pole
VARYING vec4 sky_above;    // the irradiance map straight up, with neighbors; last_level
VARYING vec4 sky_below;    // straight down; the sphere's row in the draw list

#ifdef VERTEX_STAGE
void writeLobe(Lobe lobe, Glint glint, uint row) {
  lobe_levels = vec4(lobe.environment_level, lobe.specular_level, lobe.specular_weight, lobe.level_per_shift);
  lobe_shape = vec4(lobe.spot_shape.alpha2, lobe.spot_shape.tail, lobe.spot_shape.bump, lobe.spot_shape.per_core);
  lobe_spot = vec4(lobe.spot, lobe.specular_pole);
  lobe_light = vec4(lobe.spot_light, lobe.irradiance_pole);
  lobe_cut = vec4(lobe.spot_limit, lobe.spot_cut, glint.at);
  lobe_glint = vec4(glint.falloff, glint.middle, glint.strength, lobe.environment_pole);
  vec3 above = vec3(0.0), below = vec3(0.0);
#if defined HAS_NEIGHBORS && defined HAS_IRRADIANCE
  vec2 lookup = vec2(0.0, lobe.irradiance_pole);
  above = sampleEquirect(irradiance, vec2(0.0), lookup).rgb;
  below = sampleEquirect(irradiance, vec2(0.0, 1.0), lookup).rgb;
#endif
  sky_above = vec4(above, lobe.last_level);
  sky_below = vec4(below, float(row));
}
#else
Lobe readLobe() {
  SpotShape shape = SpotShape(lobe_shape.x, lobe_shape.y, lobe_shape.z, lobe_shape.w);
  return Lobe(lobe_levels.x, lobe_glint.w, lobe_levels.y, lobe_spot.w, sky_above.w, lobe_levels.w, lobe_levels.z, lobe_light.w,
              lobe_spot.xyz, shape, lobe_light.rgb, lobe_cut.x, lobe_cut.y);
}
Glint readGlint() { return Glint(lobe_cut.zw, lobe_glint.x, lobe_glint.y, lobe_glint.z); }
uint readRow() { return uint(sky_below.w); }
#endif

#endif
