// The light that leaves each surface of the G-buffer towards the eye.
// read    normal, base, metallic_roughness, depth   see gbuffer.glsl
//         emissive?     radiance that is added
//         position?     world, instead of the one that depth gives
//         ao?           ambient visibility; the material's occlusion counts where it is darker
//         the lights: shading/light.glsl
// modify  radiance      scene-referred, alpha 1; nothing where the G-buffer has no surface
// params, defines       see shading/light.glsl and shading_model.glsl
//         SHOW_LAMPS    instead of light, how many lamps each pixel goes through, see shading/show_lamps.glsl
#include "gbuffer.glsl"
#include "shading_model.glsl"
#include "shading/light.glsl"
#include "shading/lobe.glsl"
#include "shading/show_lamps.glsl"

uniform sampler2D normal, base, metallic_roughness, depth;
#ifdef HAS_EMISSIVE
uniform sampler2D emissive;
#endif
#ifdef HAS_POSITION
uniform sampler2D position;
#endif
#ifdef HAS_AO
uniform sampler2D ao;
#endif
in vec2 uv;
#ifdef HAS_RADIANCE
out vec4 radiance;
#endif

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec2 turned = texelFetch(normal, pixel, 0).rg;
  if (turned == vec2(0.0)) discard;
#ifdef HAS_RADIANCE
  vec4 stored = texelFetch(metallic_roughness, pixel, 0);
  float visible = stored.b;
#ifdef HAS_AO
  visible = min(visible, texelFetch(ao, pixel, 0).r);
#endif
#ifdef HAS_POSITION
  vec3 at = texelFetch(position, pixel, 0).xyz;
#else
  vec3 at = positionOfDepth(uv, texelFetch(depth, pixel, 0).r);
#endif
  Point point = pointAt(at, decodeNormal(turned), visible);
  Surface surface = Surface(texelFetch(base, pixel, 0).rgb, stored.r, stored.g);
  Response response = modelResponse(surface, stored.a > 0.0 ? decodeExponent(stored.a) : 0.0, point.nv);

  LightsSeen seen = lightsSeen(point);
  Ambient ambient = ambientOf(point, response, lobeOf(response.roughness, 0.0), seen);
  Light light = lightOf(point, response, ambient, seen);
#ifdef HAS_EMISSIVE
  light.radiance += texelFetch(emissive, pixel, 0).rgb;
#endif
#if SHOW_LAMPS
  light.radiance = colorOfLamps(light.lamps_tried);
#endif
  radiance = vec4(light.radiance, 1.0);
#endif
}
