// The places on a disc at which the bokeh passes sample: rings of 5, 10, 15 ... around the middle, so that each place stands for the same area.
#ifndef DOF_RINGS_GLSL
#define DOF_RINGS_GLSL

// Directions of 18 degrees, and of a step around the n-th ring.
const vec2 kStart = vec2(0.951056516, 0.309016994);
// From the fourth ring on each ring begins at another angle (the golden angle on), because equal beginnings would make spokes.
const vec2 kGolden = vec2(-0.737368878, 0.675490294);
const vec2 kStep[9] = vec2[9](vec2(1.0, 0.0), vec2(0.309016994, 0.951056516), vec2(0.809016994, 0.587785252), vec2(0.913545458, 0.406736643),
                              vec2(0.951056516, 0.309016994), vec2(0.968583161, 0.248689887), vec2(0.978147601, 0.207911691),
                              vec2(0.983930, 0.178557), vec2(0.987688341, 0.156434465));

vec2 turned(vec2 direction, vec2 by) { return vec2(direction.x * by.x - direction.y * by.y, direction.x * by.y + direction.y * by.x); }
vec2 startOfNext(vec2 start, int ring) { return ring > 2 ? turned(start, kGolden) : start; }

// The n-th ring is this far out.
float ringRadius(int ring, float span, float samples) { return ring == 0 ? 0.0 : span * sqrt((1.0 + 2.5 * float(ring * ring)) / samples); }

#if POLYGON
// How far out the polygon of the blades is in this direction, of the radius of its corners.
float outline(vec2 direction) {
  float sector = 6.28318530717959 / float(blades), angle = atan(direction.y, direction.x);
  return cos(sector * 0.5) / cos(mod(angle, sector) - sector * 0.5);
}
#endif

#endif
