// Shows a texture: a part of it, one channel or three, a range of values, and marks for NaN and infinity. The viewer's texture inspector
// draws with it, and a pass may too.
// read    source   2D texture of any format; texels are fetched
// write   result   display-referred
// params  origin            texel at the lower left corner of the result
//         texels_per_pixel  above 1: the nearest texel is shown, and marks for any texel that the pixel covers
//         channel           0: rgb, 1..4: red, green, blue, alpha
//         low, high         values shown black and white
//         ev                stops, before the range
//         false_color       1: one value as colors, blue to red; 2: a direction as red, green and blue; 3: a motion in two channels as
//                           hue and brightness; 4: a direction in two channels, octahedral
//         encode            above 0: sRGB curve, for linear light
//         highlight         above 0: NaN magenta, infinite cyan, above the range yellow, below it blue, in stripes
//         near              above 0: reversed depth d is shown as near / d, infinitely far as the largest
// defines INTEGER           0: floats, 1: unsigned integers, 2: signed integers
#include "../common/octahedral.glsl"
#include "../common/srgb.glsl"

#ifndef INTEGER
#define INTEGER 0
#endif
#if INTEGER == 1
uniform usampler2D source;
#elif INTEGER == 2
uniform isampler2D source;
#else
uniform sampler2D source;
#endif
layout(std140) uniform Parameters {
  vec2 origin;
  float texels_per_pixel;
  int channel;
  float low;
  float high;
  float ev;
  int false_color;
  int encode;
  int highlight;
  float near;
};
out vec4 result;

// The Turbo colormap by polynomials: Mikhailov, "Turbo, an improved rainbow colormap for visualization", 2019.
vec3 colorOf(float x) {
  const vec4 kRed = vec4(0.13572138, 4.61539260, -42.66032258, 132.13108234);
  const vec4 kGreen = vec4(0.09140261, 2.19418839, 4.84296658, -14.18503333);
  const vec4 kBlue = vec4(0.10667330, 12.64194608, -60.58204836, 110.36276771);
  const vec2 kRed2 = vec2(-152.94239396, 59.28637943), kGreen2 = vec2(4.27729857, 2.82956604), kBlue2 = vec2(-89.90310912, 27.34824973);
  x = clamp(x, 0.0, 1.0);
  vec4 v4 = vec4(1.0, x, x * x, x * x * x);
  vec2 v2 = v4.zw * v4.z;
  return vec3(dot(v4, kRed) + dot(v2, kRed2), dot(v4, kGreen) + dot(v2, kGreen2), dot(v4, kBlue) + dot(v2, kBlue2));
}

vec4 valueAt(ivec2 at) {
  vec4 value = vec4(texelFetch(source, at, 0));
  if (near > 0.0) value = vec4(value.r > 0.0 ? near / value.r : 3.402823e38);
  return value;
}

// 0 and 1: red; a third: green.
vec3 hueOf(float turn) { return clamp(abs(fract(turn + vec3(0.0, 2.0, 1.0) / 3.0) * 6.0 - 3.0) - 1.0, 0.0, 1.0); }

bvec2 marksOf(vec4 value) {  // NaN, infinite: of the channels that are shown
  if (channel > 0) value = vec4(value[channel - 1]);
  return bvec2(any(isnan(value.rgb)), any(isinf(value.rgb)));
}

void main() {
  ivec2 size = textureSize(source, 0);
  vec2 corner = origin + floor(gl_FragCoord.xy) * texels_per_pixel;
  ivec2 at = ivec2(floor(corner + 0.5 * texels_per_pixel));
  if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size))) {
    bool odd = ((int(gl_FragCoord.x) / 8 + int(gl_FragCoord.y) / 8) & 1) != 0;
    result = vec4(vec3(odd ? 0.16 : 0.2), 1.0);
    return;
  }
  vec4 value = valueAt(at);
  vec3 shown = channel == 0 ? value.rgb : vec3(value[channel - 1]);
  if (false_color == 2) shown = value.rgb * 0.5 + 0.5;
  if (false_color == 3) shown = length(value.xy) * hueOf(atan(value.y, value.x) / 6.28318531);
  if (false_color == 4) shown = value.xy == vec2(0.0) ? vec3(0.0) : decodeNormal(value.xy) * 0.5 + 0.5;
  if (false_color == 1 && channel == 0) shown = vec3(dot(shown, vec3(0.2126, 0.7152, 0.0722)));
  vec3 scaled = (shown * exp2(ev) - low) / max(high - low, 1e-30);
  vec3 color = clamp(scaled, 0.0, 1.0);
  if (false_color == 1) color = colorOf(scaled.r);
  else if (encode > 0 && false_color == 0) color = encodeSrgb(color);
  if (highlight > 0) {
    bool stripe = ((int(gl_FragCoord.x) + int(gl_FragCoord.y)) & 4) != 0;
    if (stripe && any(greaterThan(scaled, vec3(1.0)))) color = mix(color, vec3(1.0, 0.9, 0.0), 0.6);
    if (stripe && any(lessThan(scaled, vec3(0.0)))) color = mix(color, vec3(0.1, 0.2, 1.0), 0.6);
#if INTEGER == 0
    bvec2 marks = marksOf(value);
    int reach = clamp(int(ceil(texels_per_pixel)), 1, 8);
    for (int y = 0; y < reach; ++y)
      for (int x = 0; x < reach; ++x) {
        ivec2 beside = ivec2(floor(corner)) + ivec2(x, y);
        if (texels_per_pixel > 1.0 && all(greaterThanEqual(beside, ivec2(0))) && all(lessThan(beside, size))) {
          bvec2 there = marksOf(valueAt(beside));
          marks = bvec2(marks.x || there.x, marks.y || there.y);
        }
      }
    if (marks.y) color = vec3(0.0, 1.0, 1.0);
    if (marks.x) color = vec3(1.0, 0.0, 1.0);
#endif
  }
  result = vec4(color, 1.0);
}
