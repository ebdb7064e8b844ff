// The brightest spot in a small sphere: its reflection is smaller than a pixel, so each pixel gets the share of it that falls into its own
// square. All shares add up to 1 wherever the spot is seen: a glint that moves keeps its light from frame to frame, and a pixel has what
// supersampling would give it. A sphere of radius r scatters r^2 / 4 of what comes from one direction into each steradian.
#ifndef SPHERES_GLINT_GLSL
#define SPHERES_GLINT_GLSL

// The share of a pixel at the distance d along each axis is  strength g.x g.y / ((1 + middle g.x + g.x^2) (1 + middle g.y + g.y^2)),
// g = exp2(-falloff |d|).
struct Glint {
  vec2 at;  // pixels
  float falloff, middle, strength;
};

// What it adds to spotStrength() of shading/ambient.glsl. `coverage`: the sphere's share of the pixel.
float glintStrength(Glint glint, vec2 pixel, float coverage) {
  vec2 g = exp2(-abs(pixel - glint.at) * glint.falloff), by = 1.0 + g * (glint.middle + g);
  return glint.strength * g.x * g.y / (by.x * by.y * max(coverage, 0.1));
}

#endif
