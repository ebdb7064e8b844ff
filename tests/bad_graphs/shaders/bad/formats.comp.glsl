// The format of the image depends on a define.
layout(local_size_x = 8, local_size_y = 8) in;
#if MODE == MODE_A
layout(rgba16f) writeonly uniform image2D result;
#else
layout(rgba8) writeonly uniform image2D result;
#endif

void main() { imageStore(result, ivec2(gl_GlobalInvocationID.xy), vec4(1.0)); }
