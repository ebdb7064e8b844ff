// What the vertex shader of spheres/billboard hands to its fragments, in seven vectors, besides the eight of spheres/lobe_varyings.glsl.
#ifndef SPHERES_BILLBOARD_VARYINGS_GLSL
#define SPHERES_BILLBOARD_VARYINGS_GLSL

#include "spheres/lobe_varyings.glsl"

VARYING vec4 sphere;            // center in view space; radius
VARYING vec4 albedo_roughness;
VARYING vec4 edge_metallic;     // silhouette_shift, square_side; metallic; near plane, negative when offsets count from the view's axis
VARYING vec4 anchor_slope;      // where offsets count from, pixels; slope of a ray per pixel
// Axes of the view in the world; the third is their cross product. w of the three: the eye.
VARYING vec4 right_eye;
VARYING vec4 up_eye;
VARYING vec4 before_eye;        // x, y and w in last frame's clip space of the eye as the moving sphere saw it

#endif
