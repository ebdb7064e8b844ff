// Shared by the passes of motion blur. Velocities are stored as screen UV per frame; blur is counted in pixels.
#ifndef MOTION_BLUR_BLUR_GLSL
#define MOTION_BLUR_BLUR_GLSL

// Half of the path of a point while the shutter is open, in pixels: the point is seen from -streak to +streak around its place.
// It is at most a tile less one pixel (by which sampling may be off), so that the 3x3 tiles around a pixel have everything that
// can reach it.
vec2 streakOf(vec2 velocity, vec2 size, float shutter, int tile) {
  vec2 streak = velocity * size * (shutter / 720.0);
  float span = length(streak), longest = float(tile) - 1.0;
  return span > longest ? streak * (longest / span) : streak;
}

// Whether anything in a tile, or in those around it, moves half a pixel while the shutter is open.
bool tileMoves(vec2 longest, vec2 size, float shutter, int tile) { return length(streakOf(longest, size, shutter, tile)) >= 0.25; }

#endif
