layout(local_size_x = 8, local_size_y = 2) in;
layout(rgba8) writeonly uniform image2D result;

void main() { imageStore(result, ivec2(gl_GlobalInvocationID.xy) % 8, vec4(1.0)); }
