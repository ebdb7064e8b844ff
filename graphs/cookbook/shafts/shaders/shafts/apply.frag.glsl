// The haze between the eye and what is seen. Blended premultiplied.
// read    depth      reversed-Z
//         seen       rgb: radiance, a: transmittance, at the end of each layer
// modify  radiance   scene-referred
#include "deferred/gbuffer.glsl"
#include "cells.glsl"

uniform sampler2D depth;
uniform sampler3D seen;
layout(std140) uniform Parameters { float far; };
in vec2 uv;
out vec4 radiance;

void main() {
  float layers = float(textureSize(seen, 0).z);
  float share = min(distanceOfDepth(texelFetch(depth, ivec2(gl_FragCoord.xy), 0).r) / far, 1.0);
  // A texel holds what is true at the end of its layer: half a texel behind its center.
  float layer = layerOf(share, layers) - 0.5;
  vec4 haze = textureLod(seen, vec3(uv, layer / layers), 0.0);
  haze = mix(vec4(0.0, 0.0, 0.0, 1.0), haze, clamp(layer + 0.5, 0.0, 1.0));
  radiance = vec4(haze.rgb, 1.0 - haze.a);
}
