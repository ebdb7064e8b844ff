// read    table      see tail.comp
// write   shown      what was written of it, a column each
layout(local_size_x = 8, local_size_y = 8) in;
layout(std430) readonly buffer table { float squares[16]; };
layout(r32f) writeonly uniform image2D shown;

void main() {
  imageStore(shown, ivec2(gl_GlobalInvocationID.xy), vec4(squares[gl_LocalInvocationID.x]));
}
