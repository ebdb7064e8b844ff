// The light of surfaces, as reflections see it: nothing of the sky, so that a blurred lookup near its edge has none.
// read    shown, depth   the picture without reflections
// write   light          alpha 1 where there is a surface
#include "common/finite.glsl"

uniform sampler2D shown, depth;
out vec4 light;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  light = texelFetch(depth, at, 0).r > 0.0 ? vec4(finite(texelFetch(shown, at, 0).rgb), 1.0) : vec4(0.0);
}
