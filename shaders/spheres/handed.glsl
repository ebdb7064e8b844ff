// What the vertex shader of spheres/billboard hands to its fragments besides shading/handed.glsl: 15 vectors in all.
#ifndef SPHERES_HANDED_GLSL
#define SPHERES_HANDED_GLSL

#include "shading/handed.glsl"

HANDED vec4 sphere;            // centre in view space, radius
HANDED vec4 albedo_roughness;
HANDED vec4 edge_metallic;     // shift of the silhouette in pixels; side of the square for a small sphere, else 0: see edgeOf; z: 1 when pixel offsets
                               // count from the centre, 0 when from the axis
HANDED vec4 anchor_row;        // where they count from, in pixels; near plane; row in the draw list
// What the fragments need of the view: in software an input costs less than a member of a block.
HANDED vec4 per_pixel;         // slope, screen UV
HANDED vec4 right_eye;         // first axis of the view in the world; w of the three: the eye
HANDED vec4 up_eye;            // second one
HANDED vec4 before_eye;        // x, y and w in last frame's clip space of the eye as the moving sphere saw it

#endif
