// A map of the sun is a window of the map that would hold the whole scene: stretched, it has finer texels.
struct Window {
  vec2 corner;  // lower left, in 0..1 of the whole
  float size;   // side, in 0..1 of the whole
  float end;    // distance along the view axis at which the next map takes over
  float texel;  // world units
  float unused[3];
};
