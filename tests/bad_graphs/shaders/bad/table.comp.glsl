// An instance table with a field that the scene does not have.
layout(local_size_x = 1) in;
struct Row { vec3 center; float colour; };
layout(std430) readonly buffer rows { Row row[]; };
layout(rgba8) uniform writeonly image2D result;

void main() { imageStore(result, ivec2(0), vec4(row[0].center, row[0].colour)); }
