// What each surface of the G-buffer reflects of the picture. Of 4 x 4 pixels each has a sixteenth of the lobe's directions;
// reflections/gather.frag.glsl brings them together.
// read    normal, metallic_roughness, depth   see deferred/gbuffer.glsl
//         brdf                                see shading/material.glsl
//         the slots of reflections/lobe.glsl
// write   mirrored, reach   see reflectedPicture()
// params  sky_turn   rotation of the environment, in full turns
//         rays       of a pixel
// define  MODEL      see deferred/shading_model.glsl
#include "deferred/gbuffer.glsl"
#include "deferred/shading_model.glsl"

#define HAS_SKY_TURN 1
layout(std140) uniform Parameters {
  float sky_turn;
  int rays;
};
#include "shading/environment.glsl"
#include "reflections/lobe.glsl"

uniform sampler2D normal, metallic_roughness, depth;
in vec2 uv;
out vec4 mirrored;
out float reach;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec2 turned = texelFetch(normal, pixel, 0).rg;
  mirrored = vec4(0.0);
  reach = 0.0;
  if (turned == vec2(0.0)) return;
  vec4 stored = texelFetch(metallic_roughness, pixel, 0);
  Point point = pointAt(positionOfDepth(uv, texelFetch(depth, pixel, 0).r), decodeNormal(turned), 1.0);
  Response response = modelResponse(Surface(vec3(1.0), stored.r, stored.g), stored.a > 0.0 ? decodeExponent(stored.a) : 0.0, point.nv);
  mirrored = reflectedPicture(point, response, (((pixel.x + pixel.y) & 3) << 2) + (pixel.x & 3), 16, rays, reach);
}
