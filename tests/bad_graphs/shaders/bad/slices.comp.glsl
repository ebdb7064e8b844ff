layout(local_size_x = 8) in;
layout(rgba8) uniform writeonly image2D result;

void main() { imageStore(result, ivec2(gl_GlobalInvocationID.xy), vec4(1.0)); }
