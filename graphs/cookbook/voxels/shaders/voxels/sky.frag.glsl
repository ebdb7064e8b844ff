// write   radiance
#include "common/view.glsl"
#include "sky_at.glsl"

in vec2 uv;
out vec4 radiance;

void main() { radiance = vec4(skyAt(normalize(viewRay(uv)), 0.01), 1.0); }
