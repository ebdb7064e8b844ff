// The picture that the lighting of now makes, over the one that the lighting before made. Scene-referred, linear in radiance.
// read    now      radiance, nearest: own texel of what `result` modifies, with "feedback"
//         before   radiance, the same size, nearest
// modify  result   radiance; alpha stays
// params  share    of `now`, 0..1
uniform sampler2D now, before;
layout(std140) uniform Parameters { float share; };
out vec4 result;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec4 own = texelFetch(now, at, 0);
  result = vec4(mix(texelFetch(before, at, 0).rgb, own.rgb, share), own.a);
}
