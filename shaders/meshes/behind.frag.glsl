// The picture as meshes that transmit see it.
// read    shown, depth   the picture without them, reversed-Z
// write   behind         radiance; alpha: one over the distance from the eye, 0 for the sky
#include "common/finite.glsl"
#include "common/view.glsl"

uniform sampler2D shown, depth;
out vec4 behind;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  behind = vec4(finite(texelFetch(shown, at, 0).rgb), texelFetch(depth, at, 0).r / (near_plane * length(viewRay(gl_FragCoord.xy / viewport))));
}
