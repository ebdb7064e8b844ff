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

// World direction of the ray through a point of the target, 0..1 from its lower left corner. Not normalized: its
// component along the view axis is 1. Perspective views only; exact, without a matrix inverse.
vec3 viewRay(vec2 target_uv) {
  vec2 ndc = target_uv * 2.0 - 1.0;
  vec2 slope = (ndc + projection[2].xy) / vec2(projection[0].x, projection[1].y);
  vec3 x = view[0].xyz, y = view[1].xyz, z = view[2].xyz;
  return vec3(slope.x * x.x + slope.y * x.y - x.z, slope.x * y.x + slope.y * y.y - y.z, slope.x * z.x + slope.y * z.y - z.z);
}

// Unit direction from a surface towards the viewer.
vec3 towardsEye(vec3 position) {
  return projection[3].w == 0.0 ? normalize(eye - position) : transpose(mat3(view))[2];
}

// Radians that one pixel covers at the center of the view.
float pixelAngle() { return 2.0 / (projection[1].y * viewport.y); }

// Share of a pixel that a lookup for it covers, and its angle. With jitter, frames are averaged, which blurs already.
float lookupShare() { return jitter == vec2(0.0) ? 1.0 : 0.5; }
float lookupAngle() { return lookupShare() * pixelAngle(); }

#endif
