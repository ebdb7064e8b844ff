// Fogs a picture in which each pixel shows one surface or the sky: that of a G-buffer, before blended surfaces are drawn.
// read    depth    reversed-Z, nearest
//         air?     see fog.glsl; without it nothing is drawn
// modify  result   radiance, with "blend": "premultiplied"
#include "common/view.glsl"
#include "sky.glsl"

uniform sampler2D depth;
in vec2 uv;
out vec4 result;

void main() {
  result = vec4(0.0);
#ifdef HAS_AIR
  float z = texelFetch(depth, ivec2(gl_FragCoord.xy), 0).r;
  vec3 ray = viewRay(uv);
  float hidden = 1.0 - (z > 0.0 ? throughFog(ray * (near_plane / z)) : throughFogOfSky(ray));
  result = vec4(fog_light.rgb * hidden, hidden);
#endif
}
