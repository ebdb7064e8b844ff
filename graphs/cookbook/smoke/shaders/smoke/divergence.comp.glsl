// How much more flows out of a cell than into it. The walls do not move.
// read    moved        xyz: velocity
// write   divergence
layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

uniform sampler3D moved;
layout(r16f) uniform writeonly image3D divergence;

float along(ivec3 cell, int axis) {
  bool outside = cell[axis] < 0 || cell[axis] >= textureSize(moved, 0)[axis];
  return outside ? 0.0 : texelFetch(moved, cell, 0)[axis];
}

void main() {
  ivec3 cell = ivec3(gl_GlobalInvocationID);
  if (any(greaterThanEqual(cell, textureSize(moved, 0)))) return;
  float sum = along(cell + ivec3(1, 0, 0), 0) - along(cell - ivec3(1, 0, 0), 0) + along(cell + ivec3(0, 1, 0), 1) -
              along(cell - ivec3(0, 1, 0), 1) + along(cell + ivec3(0, 0, 1), 2) - along(cell - ivec3(0, 0, 1), 2);
  imageStore(divergence, cell, vec4(0.5 * sum));
}
