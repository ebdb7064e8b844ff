// Ambient visibility by horizons: in slices through the view direction, the cosine-weighted integral between the highest
// occluders on both sides (GTAO: Jimenez, Wu, Pesce and Jarabo, "Practical real-time strategies for accurate indirect
// occlusion", SIGGRAPH 2016 courses). Nothing below the tangent plane occludes, so a plane is exactly 1.
// With `backs`, an occluder ends at its back face and the sky between it and the surface behind it is visible: the occluders of one side
// are one interval of angles. Without it, all space behind an occluder is solid, which is too dark beside round objects seen from low
// angles.
// read    depth, normal   the G-buffer's
//         occluders?      see ao/surface.glsl
//         backs?          depth of the nearest back faces; 0: there are none
// write   result          half size; x: visibility, y: distance along the view axis, 0 for the sky
// params  radius    world units: the reach of occluders, with a soft end
//         slices    directions per pixel; 16 pixels next to each other take different ones
//         steps     samples on each side of a slice
#include "surface.glsl"

layout(std140) uniform Parameters {
  float radius;
  int slices;
  int steps;
};
#ifdef HAS_BACKS
uniform sampler2D backs;
#endif
out vec2 result;

const float kTangent = 0.02;  // sine of the elevation below which a sample counts as part of the surface
const float kSoftEnd = 0.4;   // share of the radius over which occluders fade

// Cosine-weighted visibility between the normal's plane and a horizon: equation 7 of the paper.
float arc(float horizon, float tilt, float cos_tilt) {
  return 0.25 * (cos_tilt + 2.0 * horizon * sin(tilt) - cos(2.0 * horizon - tilt));
}

void main() {
  ivec2 half_texel = ivec2(gl_FragCoord.xy), pixel = pixelOf(half_texel), last = textureSize(depth, 0) - 1;
  float z = texelFetch(depth, pixel, 0).r;
  result = vec2(1.0, 0.0);
  if (z <= 0.0) return;
  vec3 place = placeAt(pixel, z), n = facing(pixel), v = normalize(-place);
  vec2 focal = focalPixels();

  // Directions and first steps vary over 8 x 8 pixels, and evenly over each 4 x 4 of them: ordered dither.
  uvec2 tile = uvec2(half_texel) & 7u;
  uint mixed = tile.x ^ tile.y, place_in_order = (mixed & 1u) << 5 | (tile.y & 1u) << 4 | (mixed & 2u) << 2 | (tile.y & 2u) << 1 |
                                                 (mixed & 4u) >> 1 | tile.y >> 2;
  float turn = (float(place_in_order) + 0.5) / 64.0, start = fract(float(place_in_order) * 0.618034);
  float visibility = 0.0, whole = 1e-6;
  for (int i = 0; i < slices; ++i) {
    float phi = (float(i) + turn) / float(slices) * kPi;
    vec3 along = vec3(cos(phi), sin(phi), 0.0);
    vec3 across = normalize(cross(along - dot(along, v) * v, v));
    vec3 projected = n - across * dot(n, across);
    float share = length(projected);
    if (share < 1e-4) continue;
    float cos_tilt = clamp(dot(projected, v) / share, -1.0, 1.0);
    float tilt = (dot(along - dot(along, v) * v, projected) < 0.0 ? -1.0 : 1.0) * acos(cos_tilt);
    vec2 reach = along.xy * focal * (radius / -place.z);  // pixels
    float pixel_of_reach = 1.0 / max(length(reach), 1e-3), seen = 0.0;
    for (int side = 0; side < 2; ++side) {
      // Angles from the view direction are positive along the slice; the paper's h1 is on the negative side.
      float way = side == 0 ? 1.0 : -1.0, lowest = -way * sin(tilt), horizon = lowest, back = lowest, strongest = 0.0;
      for (int j = 0; j < steps; ++j) {
        float t = (float(j) + start) / float(steps);
        float far = max(t * t, (float(j) + 1.0) * pixel_of_reach);  // dense near the pixel, never the pixel itself
        ivec2 to = ivec2(floor(vec2(pixel) + 0.5 + way * far * reach)), at = clamp(to, ivec2(0), last);
        float there = depthOfOccluder(at);
        vec3 delta = placeAt(at, max(there, 1e-12)) - place;  // the sky is far
        float distance2 = dot(delta, delta), per_length = inversesqrt(max(distance2, 1e-20));
        float weight = clamp((radius - distance2 * per_length) / (kSoftEnd * radius), 0.0, 1.0);
        if (at != to || dot(delta, n) * per_length < kTangent) weight = 0.0;
        horizon = max(horizon, mix(lowest, dot(delta, v) * per_length, weight));
#ifdef HAS_BACKS
        // The end of the interval: the lowest back face; a fading occluder counts by its share.
        float behind = texelFetch(backs, at, 0).r, end = lowest;
        if (behind > 0.0 && behind <= there) end = max(end, dot(normalize(placeAt(at, behind) - place), v));
        end = mix(lowest, end, weight);
        float share_of_other = min(weight, strongest) / max(max(weight, strongest), 1e-6);
        bool stronger = weight >= strongest;
        float of_stronger = stronger ? end : back, of_other = stronger ? back : end;
        if (weight > 0.0) back = min(of_stronger, mix(of_stronger, of_other, share_of_other));
        strongest = max(strongest, weight);
#endif
      }
      seen += arc(way * acos(clamp(horizon, -1.0, 1.0)), tilt, cos_tilt);
#ifdef HAS_BACKS
      if (strongest > 0.0) seen += arc(tilt + way * 0.5 * kPi, tilt, cos_tilt) - arc(way * acos(clamp(back, -1.0, 1.0)), tilt, cos_tilt);
#endif
    }
    visibility += share * seen;
    whole += share * (cos_tilt + tilt * sin(tilt));  // without occluders; its mean over all directions is 1
  }
  result = vec2(1.0 - (whole - visibility) / float(slices), -place.z);
}
