// A pass of @NAME@, by PASS. The lines of @NAME@.hook.glsl are those of mpv's file.
layout(local_size_x = THREADS_X, local_size_y = THREADS_Y) in;
layout(rgba16f) uniform writeonly image2D out_image;
vec2 mpvPlace(vec2 id) { return (id + 0.5) / vec2(imageSize(out_image)); }
vec2 mpv_place = mpvPlace(vec2(gl_GlobalInvocationID.xy));
#include "mpv.glsl"
#include "@NAME@.hook.glsl"
void main() { hook(); }
