// Depth alone.
// read    thing_in_front?  see in_front.glsl: nothing else is drawn
// modify  depth  reversed-Z
#include "in_front.glsl"

void main() {
  if (isBehindAnother()) discard;
}
