// Turns scene-referred into display-referred values. The last pass that reads radiance; later ones work on encoded values.
// The order: aberration, bloom, exposure, white balance, vignette, grading (saturation, contrast); tone curve; grading (lift,
// gamma, gain), sRGB encoding, table, grain, dither. Steps that are off are not compiled. docs/effects.md has the details.
// read    color   scene-referred radiance, the target's size, not `as linear`: one texel per pixel
//         shifted?  the same `as linear`, for ABERRATION
//         bloom?  scene-referred, any size; `as linear` unless its size is the target's: the blurred bright part
//         exposure?  buffer of exposure/adapt.comp.glsl, `as uniform`: a factor beside `ev`; without it, or below 0, there is none
//         lut?    3D table on encoded values, `as linear`; see lut.glsl. With it the parameter lut_strength, 0..1
// write   result  display-referred, sRGB encoded
// params  the first three together, or none for the defaults in brackets:
//         ev              exposure in stops; +1 doubles [0]
//         bloom_strength  share of the bright part that its blur replaces, 0..1 [0.05]
//         white           radiance, after exposure, that becomes white [8]
//         threshold, knee what the bright part is, as in bloom/prefilter; both or none [0, 0: everything]
//         curve           CURVE, see tone_curve.glsl
//         aberration      define: aberration_px, shift of red and blue against green at the corners, in pixels
//         white_balance   define: temperature, tint; see white_balance.glsl
//         vignette        define: vignette_stops lost in the corners, growing with the square of the distance
//         grading         define: saturation, contrast, lift, gamma, gain; see grading.glsl
//         grain           define: grain_strength; see grain.glsl
//         dither          define, default 1: half a step of noise either way before rounding to 8 bits
//                         (interleaved gradient noise, Jimenez, SIGGRAPH 2014; uniform, so means are kept)
//         SETTINGS_ARE_FLAT   the vertex shader composite/composite.vert.glsl computes what is the same for all pixels
#include "common/finite.glsl"
#include "common/srgb.glsl"
#include "settings.glsl"

#ifndef DITHER
#define DITHER 1
#endif
#ifndef SETTINGS_ARE_FLAT
#define SETTINGS_ARE_FLAT 0
#endif

#ifdef HAS_LUT
#include "lut.glsl"
#endif
#if WHITE_BALANCE
#include "white_balance.glsl"
#endif
#if GRADING
#include "grading.glsl"
#endif
#if GRAIN
#include "common/view.glsl"
#include "grain.glsl"
#endif

uniform sampler2D color;
#ifdef HAS_SHIFTED
uniform sampler2D shifted;
#endif
#ifdef HAS_BLOOM
uniform sampler2D bloom;
#endif
#ifdef HAS_LUT
uniform sampler3D lut;
#endif
#if SETTINGS_ARE_FLAT
flat in Settings settings;
#endif
noperspective in vec2 uv;
out vec4 result;

void main() {
#if !SETTINGS_ARE_FLAT
  Settings settings = settingsOf();
#endif
  vec3 c = textureLod(color, uv, 0.0).rgb;
  vec2 size = vec2(textureSize(color, 0)), pixel = floor(uv * size) + 0.5;  // gl_FragCoord would cost more in software
#if ABERRATION || VIGNETTE
  vec2 from_center = (pixel - 0.5 * size) / (0.5 * length(size));  // length 1 at the corners
#endif
#if ABERRATION && defined(HAS_SHIFTED)
  // A spectrum: the scale of the picture varies with the wavelength. Red is centered at a shift of `aberration_px`, green at 0, blue at its
  // negative; the weights of each fall to 0 at the center of the next. Samples are at most a pixel apart.
  vec2 apart = from_center * aberration_px / size;
  int places = clamp(int(ceil(length(from_center) * abs(aberration_px))), 1, 8);  // from one center to the next
  vec3 spectrum = vec3(0.0);
  for (int i = 1 - 2 * places; i < 2 * places; ++i) {
    float shift = float(i) / float(places);
    spectrum += max(1.0 - abs(shift - vec3(1.0, 0.0, -1.0)), 0.0) * textureLod(shifted, uv - shift * apart, 0.0).rgb;
  }
  c = spectrum / float(places);
#endif
  c = finite(c);
#ifdef HAS_BLOOM
  float peak = peakOf(c);
  c += settings.bloom * (textureLod(bloom, uv, 0.0).rgb - c * (brightPeak(peak, settings.bright) / peak));
#endif
  c *= settings.exposure;
#if WHITE_BALANCE
  c = whiteBalance(c, temperature, tint);
#endif
#if VIGNETTE
  c *= exp2(-vignette_stops * dot(from_center, from_center));
#endif
#if WHITE_BALANCE || defined HAS_BLOOM
  c = max(c, vec3(0.0));
#endif
#if GRADING
  c = gradeScene(c, saturation, contrast);
#endif
  c = clamp(toneCurve(c, settings.white), 0.0, 1.0);
#if GRADING
  c = clamp(gradeDisplay(c, lift, gamma, gain), 0.0, 1.0);
#endif
  c = encodeSrgb(c);
#ifdef HAS_LUT
  c = clamp(mix(c, applyLut(lut, c), lut_strength), 0.0, 1.0);
#endif
#if GRAIN
  c = addGrain(c, ivec2(pixel), frame, grain_strength);
#endif
#if DITHER
  float noise = fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))));
  c += (noise - 0.5) * (1.0 / 255.0);
#endif
  result = vec4(c, 1.0);
}
