// What a vertex shader finds out once for a whole sphere and hands to its fragments, packed: OpenGL promises 15 vectors of varyings in all.
// What is the same for all spheres is read where it is used, unless that costs more than a varying.
// Includes shading/lobe.glsl and common/equirect.glsl; the includer declares the block Parameters before.
// Fragment shaders that define LOBE_IS_FLAT take it, vertex shaders call handOn().
#ifndef SHADING_HANDED_GLSL
#define SHADING_HANDED_GLSL

#include "shading/lobe.glsl"

#if defined LOBE_IS_FLAT && LOBE_IS_FLAT
#define HANDED flat in
#else
#define HANDED flat out
#endif

// Of the Lobe: see there.
HANDED vec4 lobe_maps;
HANDED vec4 lobe_widths;
HANDED vec4 lobe_spot;    // w: poles.y
HANDED vec4 lobe_glint;   // share, cut, glint
HANDED vec4 lobe_shares;  // w: poles.x
// Values of the irradiance map straight up and straight down.
HANDED vec4 around_above; // w: poles.z
HANDED vec4 around_below; // w: poles.w

#if defined LOBE_IS_FLAT && LOBE_IS_FLAT
Lobe handedLobe() {
  return Lobe(lobe_maps, vec4(lobe_shares.w, lobe_spot.w, around_above.w, around_below.w), lobe_spot.xyz, lobe_widths, lobe_glint.x, lobe_glint.y, lobe_glint.zw,
              lobe_shares.xyz);
}
#else
void handOn(Lobe lobe) {
  lobe_maps = lobe.maps;
  lobe_widths = lobe.widths;
  lobe_spot = vec4(lobe.spot, lobe.poles.y);
  lobe_glint = vec4(lobe.share, lobe.cut, lobe.glint);
  lobe_shares = vec4(lobe.shares, lobe.poles.x);
  vec3 above = vec3(0.0), below = vec3(0.0);
#if defined HAS_NEIGHBOURS && defined HAS_IRRADIANCE
  vec2 lookup = vec2(0.0, 0.5 / float(textureSize(irradiance, 0).y));
  above = sampleEquirect(irradiance, vec2(0.0), lookup).rgb;
  below = sampleEquirect(irradiance, vec2(0.0, 1.0), lookup).rgb;
#endif
  around_above = vec4(above, lobe.poles.z);
  around_below = vec4(below, lobe.poles.w);
}
#endif

#endif
