// Depth alone.
// read    thing_in_front?  as spheres/mesh.frag.glsl writes it: nothing else is drawn
// modify  depth  reversed-Z
#ifdef HAS_THING_IN_FRONT
uniform usampler2D thing_in_front;
flat in uint thing;
#endif

void main() {
#ifdef HAS_THING_IN_FRONT
  if (texelFetch(thing_in_front, ivec2(gl_FragCoord.xy), 0).r != thing) discard;
#endif
}
