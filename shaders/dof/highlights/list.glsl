// Highlights out of focus: the list that find.comp.glsl makes, and the disc or polygon that each highlight becomes.
// defines HIGHLIGHTS  capacity of the list of a tile
//         SCALE       see dof/coc.glsl
//         POLYGON     the aperture has blades
#ifndef DOF_HIGHLIGHTS_GLSL
#define DOF_HIGHLIGHTS_GLSL

#ifndef HIGHLIGHTS
#define HIGHLIGHTS 1
#endif

struct Highlight {
  vec2 middle;   // of its disc, in pixels of the full picture
  float radius;  // of its disc, in the same pixels; negative in the near field
  float share;   // how much of the light of its texel it takes, 0 to 1
  vec4 light;    // rgb: radiance of a pixel inside its disc; a: width of the disc's soft edge in the same pixels, negative where a
                 // nearer surface may hide a part of the disc
};
struct TileHighlights {
  vec4 count;  // x: number of highlights; y: radius in pixels of the largest disc of the near field around; zw: unused
  Highlight of[HIGHLIGHTS];
};

// A round disc has the area of the aperture's outline and an edge `soft` pixels wide. This is the distance from its center at which it is
// half as bright. It is below the radius, so that the area is kept: the outer half of a round edge is larger than the inner half.
float halfwayOf(float radius, float soft, int blades) {
#if POLYGON
  float sector = 6.28318530717959 / float(blades);
  radius *= sqrt(sin(sector) / sector);
#endif
  return sqrt(radius * radius - soft * soft / 12.0);
}

// How much the corners of a disc show, 0 to 1. A disc of a few pixels has none: corners would make it wider along rows or columns of
// pixels.
float cornersOf(float radius) { return smoothstep(3.75, 4.75, radius); }

// The share of a pixel that the disc covers; `offset` is from the disc's middle to the pixel's. In the near field the polygon is upside
// down, because the rays of what is nearer than the focus have not yet crossed.
float coveredBy(float radius, float soft, vec2 offset, int blades) {
  float away = length(offset), size = abs(radius), inside = halfwayOf(size, soft, blades) - away;
#if POLYGON
  offset *= sign(radius);
  float sector = 6.28318530717959 / float(blades), within = mod(atan(offset.y, offset.x), sector) - 0.5 * sector;
  inside = mix(inside, size * cos(0.5 * sector) - away * cos(within), cornersOf(size));
#endif
  return clamp(inside / soft + 0.5, 0.0, 1.0);
}

// The disc's area in pixels, which is the sum of coveredBy() over all pixels.
float areaOf(float radius, float soft, int blades) {
#if POLYGON
  float sector = 6.28318530717959 / float(blades), inner = cos(0.5 * sector) * radius;
  return 0.5 * float(blades) * sin(sector) * radius * radius * (1.0 + cornersOf(radius) * soft * soft / (12.0 * inner * inner));
#else
  return 3.14159265 * radius * radius;
#endif
}

#endif
