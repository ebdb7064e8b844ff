// A pass of @NAME@, by PASS. The lines of @NAME@.hook.glsl are those of mpv's file.
in vec2 uv;
out vec4 result;
vec2 mpv_place = uv;
vec2 mpvPlace(vec2 id) { return (id + 0.5) * uv / gl_FragCoord.xy; }
#include "mpv.glsl"
#include "@NAME@.hook.glsl"
void main() { result = hook(); }
