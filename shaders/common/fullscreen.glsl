// The triangle of a fullscreen pass with its own vertex shader.
#ifndef COMMON_FULLSCREEN_GLSL
#define COMMON_FULLSCREEN_GLSL

// The value for gl_Position; target_uv becomes 0..1 from the lower left of the target, across all pixels. Depth is 0, the far plane.
vec4 fullscreenPosition(out vec2 target_uv) {
  target_uv = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2));
  return vec4(target_uv * 2.0 - 1.0, 0.0, 1.0);
}

#endif
