// Paints the picture of a decal on the surface behind this pixel, where that is in its box. Blended by alpha.
// read    depth, normal        of the G-buffer
//         mask                 stencil: where a surface is in a box
// modify  base                 albedo
//         metallic_roughness   see deferred/gbuffer.glsl
#include "deferred/gbuffer.glsl"
#include "boxes.glsl"
#include "pictures.glsl"

uniform sampler2D depth, normal;
flat in int decal;
out vec4 base;
out vec4 metallic_roughness;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  mat3 turn = boxAxes(decal);
  // Without surfaces the position is far away, and in no box.
  vec3 surface = positionOfDepth(gl_FragCoord.xy / viewport, max(texelFetch(depth, at, 0).r, 1e-6));
  vec3 p = transpose(turn) * (surface - places[decal].xyz) / places[decal].w;
  float covered = opacity * picture(int(colors[decal].w), p.xy);
  if (any(greaterThan(abs(p), vec3(1.0)))) discard;
  // Not on what is turned away: there the picture is drawn out long.
  covered *= smoothstep(0.2, 0.5, dot(decodeNormal(texelFetch(normal, at, 0).rg), turn[2]));
  base = vec4(colors[decal].rgb, covered);
  metallic_roughness = vec4(0.0, 0.4, 1.0, covered);
}
