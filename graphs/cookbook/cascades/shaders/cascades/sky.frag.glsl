// read    sun        as of @sun
// write   radiance
#include "common/view.glsl"
#include "scene/sun.glsl"

layout(std140) uniform Parameters { vec3 sunlight; };
#include "sky_at.glsl"

in vec2 uv;
out vec4 radiance;

void main() { radiance = vec4(skyAt(normalize(viewRay(uv))), 1.0); }
