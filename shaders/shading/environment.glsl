// The environment's maps, and where a specular lobe reads them.
// read    irradiance?    `as linear wrap`: irradiance over pi; alpha: the part of spotIrradiance() of the first spot
//         spot_cosines?  the same of the other spots, for where something hides them; x: 0
//         specular?      `as linear wrap`, prefiltered, see ibl/prefilter.comp.glsl
//         environment?   `as linear wrap`, with the mips of a box filter: for surfaces smoother than level 0 of `specular`; without it they
//                        are as rough as that level
//         brightest?     `as uniform`: the spots that `specular` lacks, see ibl/brightest.glsl
// params  sky_turn?      see shading/parameters.glsl, which is included before
#ifndef SHADING_ENVIRONMENT_GLSL
#define SHADING_ENVIRONMENT_GLSL

#include "common/equirect.glsl"
#include "ibl/brightest.glsl"
#include "ibl/roughness_level.glsl"

#ifndef HAS_SKY_TURN
const float sky_turn = 0.0;
#endif

#ifdef HAS_IRRADIANCE
uniform sampler2D irradiance;
#ifdef HAS_SPOT_COSINES
uniform sampler2D spot_cosines;
#endif
#endif
#ifdef HAS_SPECULAR
uniform sampler2D specular;
#ifdef HAS_ENVIRONMENT
uniform sampler2D environment;
#endif
#endif

// The same for all points of one roughness and curvature, with the first of the spots. A pole is how close v may come to the poles of a map.
struct Lobe {
  float environment_level;
  float environment_pole;
  float specular_level;   // for a view along the normal
  float specular_pole;    // at level 0
  float last_level;       // of `specular`
  float level_per_shift;  // what Response.level_shift is multiplied by
  float specular_weight;  // of `specular`; the rest is read from `environment`
  float irradiance_pole;
  vec3 spot;              // unit, towards the spot
  SpotShape spot_shape;
  vec3 spot_light;        // the spot's irradiance that is reflected in closed form, over 2 pi
  float spot_limit;       // radiance above which the spot is cut out of lookups of `environment`,
  float spot_cut;         // and the share of it that is cut
};

#endif
