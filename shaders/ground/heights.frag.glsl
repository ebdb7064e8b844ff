// The range of heights above the ground that meshes occupy.
// read    ground   see scene/ground.glsl
// modify  heights  x: the lowest, negative; y: the highest; "max"
#include "scene/ground.glsl"

in float height;
out vec2 heights;

void main() {
  float above = height - ground_row[0].height;
  heights = vec2(-above, above);
}
