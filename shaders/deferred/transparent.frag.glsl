// A transparent mesh, lit by the lights of the G-buffer; or an opaque one whose material has layers, in place of what the G-buffer made of
// it. Behind meshes/surface.vert.glsl.
// read    materials, material_maps?   see meshes/surface.glsl
//         material_layers?            see meshes/layers.glsl
//         behind?                     see meshes/behind.glsl
//         ao?                         as in deferred/lighting.frag.glsl
//         air?, the lights            see meshes/radiance.glsl
// modify  radiance   scene-referred, premultiplied by the material's alpha: blend "premultiplied"
//         velocity   screen UV per frame
// define  LAYERED   1: materials with layers alone
// params, defines    see shading/light.glsl and shading_model.glsl
#include "meshes/surface.glsl"
#include "shading_model.glsl"
#include "meshes/radiance.glsl"

#ifdef HAS_AO
uniform sampler2D ao;
#endif
#ifdef HAS_RADIANCE
out vec4 radiance;
#endif
#ifdef HAS_VELOCITY
out vec2 velocity;
#endif

void main() {
#ifdef HAS_MATERIAL_LAYERS
  layers = meshLayers();
#endif
  MeshSurface self = meshSurface();
#ifdef HAS_RADIANCE
#if LAYERED && defined HAS_MATERIAL_LAYERS
  if (layers_of[row].layered == 0u && !gl_HelperInvocation) discard;
  self.alpha = 1.0;
#endif
  float visible = self.occlusion;
#ifdef HAS_AO
  visible = min(visible, texelFetch(ao, ivec2(gl_FragCoord.xy), 0).r);
#endif
  Point point = pointAt(world_position, self.normal, visible);
  Surface surface = Surface(self.albedo, self.metallic, self.roughness);
  Response response = modelResponse(surface, self.shininess, point.nv);
  vec3 light = meshRadiance(self, surface, response, point);
  radiance = vec4(light * self.alpha, self.alpha);
#endif
#ifdef HAS_VELOCITY
  velocity = meshVelocity(viewport);
#endif
  if (hidden) discard;
}
