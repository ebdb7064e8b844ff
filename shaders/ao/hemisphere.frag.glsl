// Ambient visibility by sample points in the hemisphere above each surface; a point hidden by something near counts as blocked
// (Mittring, "Finding next gen: CryEngine 2", SIGGRAPH 2007 courses; in the normal's hemisphere as in Filion and McNaughton,
// "StarCraft II effects and techniques", SIGGRAPH 2008). Directions are cosine-weighted. Points below the tangent plane
// are never blocked, so a plane is exactly 1.
// read    depth, normal   the G-buffer's
//         occluders?      see ao/surface.glsl
// write   result          half size; x: visibility, y: distance along the view axis, 0 for the sky
// params  radius    world units, of the hemisphere
//         samples   points per pixel; 16 pixels next to each other take different ones
#include "surface.glsl"

layout(std140) uniform Parameters {
  float radius;
  int samples;
};
out vec2 result;

const float kTangent = 0.02;  // sine of the elevation below which a sample counts as part of the surface
const float kSoftEnd = 0.4;   // share of the radius over which occluders fade

float radicalInverse(uint bits) { return float(bitfieldReverse(bits)) * 2.3283064365386963e-10; }

void main() {
  ivec2 half_texel = ivec2(gl_FragCoord.xy), pixel = pixelOf(half_texel), last = textureSize(depth, 0) - 1;
  float z = texelFetch(depth, pixel, 0).r;
  result = vec2(1.0, 0.0);
  if (z <= 0.0) return;
  vec3 place = placeAt(pixel, z), n = facing(pixel);
  vec3 side = normalize(abs(n.x) < 0.7 ? cross(n, vec3(1.0, 0.0, 0.0)) : cross(n, vec3(0.0, 1.0, 0.0))), up = cross(n, side);
  vec2 focal = focalPixels(), size = vec2(last + 1);
  float turn = float((((half_texel.x + half_texel.y) & 3) << 2) + (half_texel.x & 3)) / 16.0;
  float blocked = 0.0;
  for (int i = 0; i < samples; ++i) {
    float u = (float(i) + 0.5) / float(samples), phi = 2.0 * kPi * (radicalInverse(uint(i)) + turn);
    float far = fract(float(i) * 0.618034 + turn);
    vec3 direction = sqrt(u) * (cos(phi) * side + sin(phi) * up) + sqrt(1.0 - u) * n;
    vec3 point = place + direction * radius * mix(0.05, 1.0, far * far);
    if (point.z >= -near_plane) continue;
    vec2 ndc = point.xy / -point.z * vec2(projection[0].x, projection[1].y) - projection[2].xy;
    ivec2 at = ivec2(floor((ndc * 0.5 + 0.5) * size));
    if (any(lessThan(at, ivec2(0))) || any(greaterThan(at, last))) continue;
    float there = depthOfOccluder(at);
    if (there <= 0.0) continue;
    vec3 surface = placeAt(at, there), delta = surface - place;
    if (surface.z <= point.z || dot(delta, n) <= kTangent * length(delta)) continue;
    blocked += clamp((radius - length(delta)) / (kSoftEnd * radius), 0.0, 1.0);
  }
  result = vec2(1.0 - blocked / float(samples), -place.z);
}
