// The blurred far field in place of the sharp picture, in tiles whose discs are alike. Scene-referred. Drawn at a depth (far_field.vert.glsl),
// so that what is in focus stays.
// read    blurred  from even.comp.glsl, `as linear`
// modify  result   radiance
//         tested   the picture's depth, with "depth_test": "greater" and "depth_write": false
uniform sampler2D blurred;
noperspective in vec2 at_half;
out vec4 result;

void main() {
  vec4 layer = textureLod(blurred, at_half, 0.0);
  if (layer.a <= 0.0) discard;  // nothing was blurred here
  result = vec4(layer.rgb / layer.a, 1.0);
}
