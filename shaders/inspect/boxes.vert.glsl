// The edges of a box in the world: 24 vertices, two for each edge.
// read  boxes  low and high corner, one row each
#include "common/view.glsl"

struct Box { vec3 low; vec3 high; };
layout(std430) readonly buffer boxes { Box box[]; };

out float along;  // the edge: 0 to 1
flat out vec3 color;

void main() {
  Box self = box[gl_InstanceID];
  int edge = gl_VertexID / 2, axis = edge / 4;
  vec3 corner;
  corner[axis] = along = float(gl_VertexID % 2);
  corner[(axis + 1) % 3] = float(edge % 2);
  corner[(axis + 2) % 3] = float(edge / 2 % 2);
  color = 0.6 + 0.4 * cos(2.4 * float(gl_InstanceID) + vec3(0.0, 2.1, 4.2));
  gl_Position = view_projection * vec4(mix(self.low, self.high, corner), 1.0);
  gl_Position.xy -= 2.0 * jitter / viewport * gl_Position.w;
  if (self.low.x > self.high.x) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // nothing is in it
}
