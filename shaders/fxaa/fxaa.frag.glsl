// Fast approximate anti-aliasing of display-referred, encoded values, after the tone curve (Lottes, FXAA 3.11): the
// pixels that fxaa/edges found, moved along their edge towards the other side.
// read    source   a copy of the encoded picture, `as linear`
//         texels   the same, not `as linear`: a nearest lookup costs less than a fetch in software
// modify  result   the picture
//         edges    depth: 0 at edges; "depth_test": "equal" keeps every other pixel from being shaded at all
// params  subpixel   softening of single pixels, 0..1
#include "luma.glsl"

uniform sampler2D source, texels;
layout(std140) uniform Parameters { float subpixel; };
noperspective in vec2 uv;
out vec4 result;

const float kStride[5] = float[5](1.0, 1.5, 2.0, 4.0, 12.0);
const float kReach = 20.5;  // their sum

void main() {
  vec2 texel = 1.0 / vec2(textureSize(source, 0)), low_uv = uv - texel, high_uv = uv + texel;
  float m = luma(textureLod(texels, uv, 0.0).rgb);
  float n = luma(textureLod(texels, vec2(uv.x, high_uv.y), 0.0).rgb);
  float s = luma(textureLod(texels, vec2(uv.x, low_uv.y), 0.0).rgb);
  float e = luma(textureLod(texels, vec2(high_uv.x, uv.y), 0.0).rgb);
  float w = luma(textureLod(texels, vec2(low_uv.x, uv.y), 0.0).rgb);
  float high = max(max(max(n, s), max(e, w)), m), low = min(min(min(n, s), min(e, w)), m);
  float range = max(high - low, 1e-4);
  float ne = luma(textureLod(texels, high_uv, 0.0).rgb);
  float sw = luma(textureLod(texels, low_uv, 0.0).rgb);
  float nw = luma(textureLod(texels, vec2(low_uv.x, high_uv.y), 0.0).rgb);
  float se = luma(textureLod(texels, vec2(high_uv.x, low_uv.y), 0.0).rgb);

  float average = (2.0 * (n + s + e + w) + ne + nw + se + sw) / 12.0;
  float blur = clamp(abs(average - m) / range, 0.0, 1.0);
  blur = blur * blur * (3.0 - 2.0 * blur);
  blur = blur * blur * subpixel;

  float horizontal = abs(nw + sw - 2.0 * w) + 2.0 * abs(n + s - 2.0 * m) + abs(ne + se - 2.0 * e);
  float vertical = abs(nw + ne - 2.0 * n) + 2.0 * abs(w + e - 2.0 * m) + abs(sw + se - 2.0 * s);
  bool is_horizontal = horizontal >= vertical;
  float before = is_horizontal ? s : w, after = is_horizontal ? n : e;
  float toward = abs(before - m) >= abs(after - m) ? -1.0 : 1.0;
  float other = toward < 0.0 ? before : after;
  float contrast = 0.25 * abs(other - m), edge_luma = 0.5 * (other + m);

  vec2 across = is_horizontal ? vec2(0.0, texel.y) : vec2(texel.x, 0.0);
  vec2 along = is_horizontal ? vec2(texel.x, 0.0) : vec2(0.0, texel.y);
  vec2 start = uv + across * toward * 0.5;
  float reach_back = 0.0, reach_on = 0.0, end_back = 0.0, end_on = 0.0;
  bool done_back = false, done_on = false;
  // Ends at a sum, not at a number of rounds, so that no compiler unrolls it: then every round would run for all pixels.
  for (int i = 0; max(reach_back, reach_on) < kReach && !(done_back && done_on); ++i) {
    if (!done_back) {
      reach_back += kStride[i];
      end_back = luma(textureLod(source, start - along * reach_back, 0.0).rgb) - edge_luma;
      done_back = abs(end_back) >= contrast;
    }
    if (!done_on) {
      reach_on += kStride[i];
      end_on = luma(textureLod(source, start + along * reach_on, 0.0).rgb) - edge_luma;
      done_on = abs(end_on) >= contrast;
    }
  }
  // Only the nearer end, and only when the edge turns towards this pixel there, moves it.
  float near_end = reach_back < reach_on ? end_back : end_on;
  float shift = (near_end < 0.0) != (m < edge_luma) ? 0.5 - min(reach_back, reach_on) / (reach_back + reach_on) : 0.0;
  shift = max(shift, blur);
  result = vec4(textureLod(source, uv + across * toward * shift, 0.0).rgb, 1.0);
}
