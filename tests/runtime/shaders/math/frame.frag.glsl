// write   result   the number of the frame
#include "common/view.glsl"
out vec4 result;

void main() { result = vec4(float(frame)); }
