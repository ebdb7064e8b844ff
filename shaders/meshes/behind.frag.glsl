// The picture as meshes that transmit see it.
// read    shown, depth   the picture without them, reversed-Z
// write   behind         radiance; alpha: one over the distance from the eye, or its plane where the view is parallel; 0 for the sky
#include "common/finite.glsl"
#include "common/view.glsl"

uniform sampler2D shown, depth;
out vec4 behind;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  float z = texelFetch(depth, at, 0).r;
  float nearness = projection[3].w == 0.0 ? z / (near_plane * length(viewRay(gl_FragCoord.xy / viewport)))
                                          : projection[2].z / (projection[3].z - z);
  behind = vec4(finite(texelFetch(shown, at, 0).rgb), z > 0.0 ? nearness : 0.0);
}
