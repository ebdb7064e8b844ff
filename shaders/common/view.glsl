// The view of the pass (default @camera), filled by the engine; see docs/shaders.md. World is right-handed, +Y up; view
// space looks along -Z. Clip depth is reversed: the near plane is 1, infinity is 0.
#ifndef COMMON_VIEW_GLSL
#define COMMON_VIEW_GLSL

layout(std140) uniform View {
  mat4 view;
  mat4 projection;
  mat4 view_projection;
  mat4 inverse_view_projection;
  mat4 previous_view_projection;  // last frame's, with this frame's jitter
  vec3 eye;
  float near_plane;
  vec3 previous_eye;
  uint frame;
  vec2 viewport;                  // pixels of the target
  vec2 jitter;                    // pixels, already in `projection`
  float time;
  float delta_time;
};

// World direction of the ray through a point of the target, 0..1 from its lower left corner. Not normalised: its
// component along the view axis is 1. Perspective views only; exact (no general inverse is involved).
vec3 viewRay(vec2 target_uv) {
  vec2 ndc = target_uv * 2.0 - 1.0;
  vec2 slope = (ndc + projection[2].xy) / vec2(projection[0].x, projection[1].y);
  return vec3(slope.x * view[0].x + slope.y * view[0].y - view[0].z,
              slope.x * view[1].x + slope.y * view[1].y - view[1].z,
              slope.x * view[2].x + slope.y * view[2].y - view[2].z);
}

// Radians that one pixel covers at the centre of the view.
float pixelAngle() { return 2.0 / (projection[1].y * viewport.y); }

#endif
