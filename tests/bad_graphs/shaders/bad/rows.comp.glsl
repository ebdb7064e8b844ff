// A storage block with an instance name, by which no slot is found.
layout(local_size_x = 1) in;
layout(std430) readonly buffer Rows { float value[]; } rows;
layout(rgba8) uniform writeonly image2D result;

void main() { imageStore(result, ivec2(0), vec4(rows.value[0])); }
