// Visibility of the sky on the ground past meshes. In each direction along the ground they hide the elevations between the lowest and the
// highest point of their height range. Of the cosine-weighted sky, the share below the elevation e in one direction is sin^2 e.
// read    heights   see ground/heights.frag.glsl; not `as linear`
// write   sky       over ground/plain.glsl
const int kDirections = 32, kSteps = 32;

#include "ground/plain.glsl"

uniform sampler2D heights;
#include "shadow/scene_bounds.glsl"

in vec2 uv;
out float sky;

void main() {
  float radius = boundingSphere().w;
  float side = float(textureSize(heights, 0).x), texel = 2.0 / side;
  // In radii of the bounding sphere.
  vec2 at = plainAt(uv);
  float away = length(at), spread = away > 1.0 ? asin(1.0 / away) : 3.14159265;
  float towards = atan(-at.y, -at.x), hidden = 0.0;
  for (int i = 0; i < kDirections; ++i) {
    float angle = towards + spread * (2.0 * (float(i) + 0.5) / float(kDirections) - 1.0);
    vec2 along = vec2(cos(angle), sin(angle));
    // Where the ray enters the sphere and leaves it.
    float middle = -dot(at, along), across2 = away * away - middle * middle, half_chord = sqrt(max(1.0 - across2, 0.0));
    float first = max(middle - half_chord, 0.5 * texel), last = middle + half_chord, factor = pow(last / first, 1.0 / float(kSteps));
    vec2 angles = vec2(1.0, 0.0);  // sine squared of the lowest and of the highest
    float from = first;
    for (int k = 0; k < kSteps; ++k) {
      float r = from * sqrt(factor);
      from *= factor;
      vec2 place = 0.5 + 0.5 * vec2(at.x + along.x * r, at.y + along.y * r) * vec2(1.0, -1.0);
      vec2 column = texelFetch(heights, ivec2(clamp(place, vec2(0.0), vec2(0.9999)) * side), 0).xy / radius;
      vec2 least = max(vec2(-column.x, column.y), vec2(0.0)), squares = least * least / (least * least + r * r);
      if (column.y > 0.0) angles = vec2(min(angles.x, squares.x), max(angles.y, squares.y));
    }
    hidden += max(angles.y - angles.x, 0.0);
  }
  sky = 1.0 - hidden / float(kDirections) * spread / 3.14159265;
}
