// modify  result  color, blended
// modify  layers  `as image`: how many fragments passed the depth test at each pixel
layout(early_fragment_tests) in;
layout(r32ui) uniform uimage2D layers;
flat in vec3 tint;
out vec4 result;

void main() {
  imageAtomicAdd(layers, ivec2(gl_FragCoord.xy), 1u);
  result = vec4(tint, 0.8);
}
