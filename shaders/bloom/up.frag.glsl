// One step up the bloom pyramid: the smaller level, enlarged bilinearly, onto the larger one. Scene-referred.
// read    source   the smaller level; any sampler (texels are fetched), for LINEAR `as linear`
// modify  result   the larger level. With "blend": "add" levels sum up; with "blend": "alpha" the larger level keeps
//                  1 - scatter of itself, so that the pyramid as a whole keeps the mean whatever its depth
// params  scatter  share of the smaller level, 0..1; wider glow for larger values. Without effect under "add"
// defines LINEAR   default 0; 1: one lookup instead of four, half the cost
#ifndef LINEAR
#define LINEAR 0
#endif
uniform sampler2D source;
#ifdef HAS_SCATTER
layout(std140) uniform Parameters { float scatter; };
#else
const float scatter = 0.0;
#endif
in vec2 uv;
out vec4 result;

void main() {
#if LINEAR
  result = vec4(textureLod(source, uv, 0.0).rgb, scatter);
#else
  ivec2 size = textureSize(source, 0);
  vec2 p = uv * vec2(size) - 0.5;
  vec2 base = floor(p), f = p - base;
  ivec2 a = max(ivec2(base), ivec2(0)), b = min(ivec2(base) + 1, size - 1);
  vec3 low = mix(texelFetch(source, a, 0).rgb, texelFetch(source, ivec2(b.x, a.y), 0).rgb, f.x);
  vec3 high = mix(texelFetch(source, ivec2(a.x, b.y), 0).rgb, texelFetch(source, b, 0).rgb, f.x);
  result = vec4(mix(low, high, f.y), scatter);
#endif
}
