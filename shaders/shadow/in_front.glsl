// Whether a fragment is of another thing than the one in front at its pixel.
// read    thing_in_front?   `thing` as meshes/forward.frag.glsl and spheres/mesh.frag.glsl write it; without it nothing is
// The vertex shader has `flat out uint thing`.
#ifndef SHADOW_IN_FRONT_GLSL
#define SHADOW_IN_FRONT_GLSL

#ifdef HAS_THING_IN_FRONT
uniform usampler2D thing_in_front;
flat in uint thing;
bool isBehindAnother() { return texelFetch(thing_in_front, ivec2(gl_FragCoord.xy), 0).r != thing; }
#else
bool isBehindAnother() { return false; }
#endif

#endif
