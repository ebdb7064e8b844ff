// What the vertex shader of a sphere finds out once about its reflections, packed into seven vectors: OpenGL promises 15 in all. Values
// that are the same for all spheres are read in the fragments, unless that costs more than a varying.
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

VARYING vec4 lobe_levels;   // environment_level, specular_level, specular_weight, level_per_shift
VARYING vec4 lobe_shape;    // of the spot: alpha2, tail, bump, per_core
VARYING vec4 lobe_spot;     // spot; specular_pole
VARYING vec4 lobe_shares;   // spot_share, spot_cut; where the glint is
VARYING vec4 lobe_glint;    // falloff, middle, strength; environment_pole
VARYING vec4 sky_above;     // the irradiance map straight up, with neighbors; irradiance_pole
VARYING vec4 sky_below;     // straight down; last_level

#ifdef VERTEX_STAGE
void writeLobe(Lobe lobe, Glint glint) {
  lobe_levels = vec4(lobe.environment_level, lobe.specular_level, lobe.specular_weight, lobe.level_per_shift);
  lobe_shape = vec4(lobe.spot_shape.alpha2, lobe.spot_shape.tail, lobe.spot_shape.bump, lobe.spot_shape.per_core);
  lobe_spot = vec4(lobe.spot, lobe.specular_pole);
  lobe_shares = vec4(lobe.spot_share, lobe.spot_cut, glint.at);
  lobe_glint = vec4(glint.falloff, glint.middle, glint.strength, lobe.environment_pole);
  vec3 above = vec3(0.0), below = vec3(0.0);
#if defined HAS_NEIGHBORS && defined HAS_IRRADIANCE
  vec2 lookup = vec2(0.0, lobe.irradiance_pole);
  above = sampleEquirect(irradiance, vec2(0.0), lookup).rgb;
  below = sampleEquirect(irradiance, vec2(0.0, 1.0), lookup).rgb;
#endif
  sky_above = vec4(above, lobe.irradiance_pole);
  sky_below = vec4(below, lobe.last_level);
}
#else
Lobe readLobe() {
  SpotShape shape = SpotShape(lobe_shape.x, lobe_shape.y, lobe_shape.z, lobe_shape.w);
  return Lobe(lobe_levels.x, lobe_glint.w, lobe_levels.y, lobe_spot.w, sky_below.w, lobe_levels.w, lobe_levels.z, sky_above.w,
              lobe_spot.xyz, shape, lobe_shares.x, lobe_shares.y);
}
Glint readGlint() { return Glint(lobe_shares.zw, lobe_glint.x, lobe_glint.y, lobe_glint.z); }
#endif

#endif
