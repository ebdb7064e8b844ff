// One step up the bloom pyramid: the smaller level, enlarged bilinearly, onto the larger one. Scene-referred.
// read    source   the smaller level, `as linear`: each texel stands for two by two
// modify  result   the larger level. With "blend": "add" levels sum up; with "blend": "alpha" the larger level keeps
//                  1 - scatter of itself, so that the pyramid as a whole keeps the mean whatever its depth
// params  scatter  share of the smaller level, 0..1; wider glow for larger values. Without effect under "add"
uniform sampler2D source;
#ifdef HAS_SCATTER
layout(std140) uniform Parameters { float scatter; };
#else
const float scatter = 0.0;
#endif
out vec4 result;

void main() { result = vec4(textureLod(source, 0.5 * gl_FragCoord.xy / vec2(textureSize(source, 0)), 0.0).rgb, scatter); }
