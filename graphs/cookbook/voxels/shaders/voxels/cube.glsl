// The cube of the voxels, in the world and in 0..1.
vec3 inCube(vec3 world) { return (world - middle) / width + 0.5; }
