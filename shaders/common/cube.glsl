// Cube maps.
#ifndef COMMON_CUBE_GLSL
#define COMMON_CUBE_GLSL

// How far along the axis of its face.
float axisOf(vec3 d) { return max(abs(d.x), max(abs(d.y), abs(d.z))); }

#endif
