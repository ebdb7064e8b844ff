// Half of what is behind a sphere shows, and where in the picture it is.
// modify  seen
#include "common/view.glsl"

flat in vec3 albedo;
out vec4 seen;

void main() { seen = vec4(albedo, gl_FragCoord.x / viewport.x) * 0.5; }
