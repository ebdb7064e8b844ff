// The velocity without the gradient of the pressure: nothing is lost or made in a cell. Nothing flows through the walls.
// read    moved      xyz: velocity, w: smoke
//         pressure
// write   flow       as moved
layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

uniform sampler3D moved, pressure;
layout(rgba16f) uniform writeonly image3D flow;

float at(ivec3 cell) { return texelFetch(pressure, clamp(cell, ivec3(0), textureSize(pressure, 0) - 1), 0).r; }

void main() {
  ivec3 cell = ivec3(gl_GlobalInvocationID), size = textureSize(moved, 0);
  if (any(greaterThanEqual(cell, size))) return;
  vec4 here = texelFetch(moved, cell, 0);
  here.xyz -= 0.5 * vec3(at(cell + ivec3(1, 0, 0)) - at(cell - ivec3(1, 0, 0)), at(cell + ivec3(0, 1, 0)) - at(cell - ivec3(0, 1, 0)),
                         at(cell + ivec3(0, 0, 1)) - at(cell - ivec3(0, 0, 1)));
  bvec3 wall = bvec3(ivec3(equal(cell, ivec3(0))) + ivec3(equal(cell, size - 1)));
  here.xyz = mix(here.xyz, vec3(0.0), wall);
  imageStore(flow, cell, here);
}
