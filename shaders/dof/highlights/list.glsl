// Highlights out of focus: the list that find.comp.glsl makes, and the outline that each of them becomes.
// defines HIGHLIGHTS  how many texels of a tile can be in the list
//         SCALE       see dof/coc.glsl
//         POLYGON     the aperture has blades
#ifndef DOF_HIGHLIGHTS_GLSL
#define DOF_HIGHLIGHTS_GLSL

#ifndef HIGHLIGHTS
#define HIGHLIGHTS 1
#endif

struct Highlight {
  vec2 middle;   // pixels of the full picture
  float radius;  // of its disc, likewise; negative in the near field
  float share;   // of its texel's light that it took
  vec4 light;    // radiance in a pixel that its disc covers; pixels from there to where it covers none
};
struct TileHighlights {
  vec4 count;  // only the first number counts
  Highlight of[HIGHLIGHTS];
};

// Where a round disc, with the area of the aperture's outline, is half as bright as in its middle, if its edge is `soft` pixels wide. The edge is bent: so that
// place is farther in than the radius, by as much as keeps the area.
float halfwayOf(float radius, float soft, int blades) {
#if POLYGON
  float sector = 6.28318530717959 / float(blades);
  radius *= sqrt(sin(sector) / sector);
#endif
  return sqrt(radius * radius - soft * soft / 12.0);
}

// How much of a disc its corners are seen of: of a few pixels none, because it would be wider along the pixels' rows or columns.
float cornersOf(float radius) { return smoothstep(3.75, 4.75, radius); }

// How much of the pixel at `offset` from the middle the disc covers. Before the focus it is upside down: there its rays have not yet crossed.
float coveredBy(float radius, float soft, vec2 offset, int blades) {
  float away = length(offset), size = abs(radius), inside = halfwayOf(size, soft, blades) - away;
#if POLYGON
  offset *= sign(radius);
  float sector = 6.28318530717959 / float(blades), within = mod(atan(offset.y, offset.x), sector) - 0.5 * sector;
  inside = mix(inside, size * cos(0.5 * sector) - away * cos(within), cornersOf(size));
#endif
  return clamp(inside / soft + 0.5, 0.0, 1.0);
}

// The sum of that over all pixels.
float areaOf(float radius, float soft, int blades) {
#if POLYGON
  float sector = 6.28318530717959 / float(blades), inner = cos(0.5 * sector) * radius;
  return 0.5 * float(blades) * sin(sector) * radius * radius * (1.0 + cornersOf(radius) * soft * soft / (12.0 * inner * inner));
#else
  return 3.14159265 * radius * radius;
#endif
}

#endif
