// write   result   the greatest difference between matrices of the parameters and of the view
#include "common/view.glsl"
layout(std140) uniform Parameters {
  mat4 seen, all;
  layout(row_major) mat4 back;
};
out float result;

void main() {
  result = 0.0;
  for (int c = 0; c < 4; ++c) {
    vec4 off = max(max(abs(seen[c] - view[c]), abs(all[c] - view_projection[c])), abs(back[c] - inverse_view_projection[c]));
    result = max(result, max(max(off.x, off.y), max(off.z, off.w)));
  }
}
