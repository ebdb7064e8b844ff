// One step of Jacobi for the pressure whose gradient takes the divergence away. At the walls it does not change.
// read    divergence, guess
// write   pressure
layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

uniform sampler3D divergence, guess;
layout(r16f) uniform writeonly image3D pressure;

float at(ivec3 cell) { return texelFetch(guess, clamp(cell, ivec3(0), textureSize(guess, 0) - 1), 0).r; }

void main() {
  ivec3 cell = ivec3(gl_GlobalInvocationID);
  if (any(greaterThanEqual(cell, textureSize(guess, 0)))) return;
  float around = at(cell + ivec3(1, 0, 0)) + at(cell - ivec3(1, 0, 0)) + at(cell + ivec3(0, 1, 0)) +
                 at(cell - ivec3(0, 1, 0)) + at(cell + ivec3(0, 0, 1)) + at(cell - ivec3(0, 0, 1));
  imageStore(pressure, cell, vec4((around - texelFetch(divergence, cell, 0).r) / 6.0));
}
