// Sound: `time` is the engine's.
#include "common/view.glsl"
out vec4 result;

void main() { result = vec4(fract(time)); }
