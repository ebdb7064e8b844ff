// Where a probe stands, for reflections/probe.glsl. The view of the pass is the probe's.
// write   place   buffer of 16 bytes
#include "common/view.glsl"

layout(local_size_x = 1) in;

layout(std430) writeonly buffer place { vec4 at_near; };

void main() { at_near = vec4(eye, near_plane); }
