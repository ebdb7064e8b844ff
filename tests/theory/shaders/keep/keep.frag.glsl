// Reads a buffer so that what wrote it is live.
// read    keys
// write   result
layout(std430) readonly buffer keys { uvec2 element[]; };
out vec4 result;

void main() { result = vec4(float(element[0].x & 1u)); }
