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
    float lowest[2] = float[2](cos(tilt + 0.5 * kPi), cos(tilt - 0.5 * kPi));
    float horizon[2] = lowest, back[2] = lowest, strongest[2] = float[2](0.0, 0.0);
    vec2 reach = along.xy * focal * (radius / -place.z);  // pixels
    float pixels = length(reach);
    for (int side = 0; side < 2; ++side) {
      vec2 way = side == 0 ? reach : -reach;
      for (int j = 0; j < steps; ++j) {
        float t = (float(j) + start) / float(steps);
        float far = max(t * t, (float(j) + 1.0) / max(pixels, 1e-3));  // dense near the pixel, never the pixel itself
        vec2 to = vec2(pixel) + 0.5 + way * far;
        ivec2 at = ivec2(floor(to));
        if (any(lessThan(at, ivec2(0))) || any(greaterThan(at, last))) break;
        float there = depthOfOccluder(at);
        if (there <= 0.0) continue;
        vec3 delta = placeAt(at, there) - place;
        float distance2 = dot(delta, delta), per_length = inversesqrt(max(distance2, 1e-20));
        if (dot(delta, n) * per_length < kTangent) continue;
        float weight = clamp((radius - distance2 * per_length) / (kSoftEnd * radius), 0.0, 1.0);
        horizon[side] = max(horizon[side], mix(lowest[side], dot(delta, v) * per_length, weight));
#ifdef HAS_BACKS
        if (weight <= 0.0) continue;
        // The end of the interval: the lowest back face; a fading occluder counts by its share.
        float behind = texelFetch(backs, at, 0).r, end = lowest[side];
        if (behind > 0.0 && behind <= there) end = max(end, dot(normalize(placeAt(at, behind) - place), v));
        end = mix(lowest[side], end, weight);
        float share_of_other = min(weight, strongest[side]) / max(weight, strongest[side]);
        back[side] = weight >= strongest[side] ? min(end, mix(end, back[side], share_of_other))
                                               : min(back[side], mix(back[side], end, share_of_other));
        strongest[side] = max(strongest[side], weight);
#endif
      }
    }
    // Angles from the view direction, positive along the slice; the paper's h1 is on the negative side.
    float right = acos(clamp(horizon[0], -1.0, 1.0)), left = -acos(clamp(horizon[1], -1.0, 1.0));
    float seen = arc(right, tilt, cos_tilt) + arc(left, tilt, cos_tilt);
#ifdef HAS_BACKS
    if (strongest[0] > 0.0) seen += arc(tilt + 0.5 * kPi, tilt, cos_tilt) - arc(acos(clamp(back[0], -1.0, 1.0)), tilt, cos_tilt);
    if (strongest[1] > 0.0) seen += arc(tilt - 0.5 * kPi, tilt, cos_tilt) - arc(-acos(clamp(back[1], -1.0, 1.0)), tilt, cos_tilt);
#endif
    visibility += share * seen;
    whole += share * (cos_tilt + tilt * sin(tilt));  // without occluders; its mean over all directions is 1
  }
  result = vec2(1.0 - (whole - visibility) / float(slices), -place.z);
}
