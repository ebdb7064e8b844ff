// Stores where it is, and has no output.
// modify  voxels
layout(r32f) uniform image3D voxels;

void main() {
  ivec2 p = ivec2(gl_FragCoord.xy);
  imageStore(voxels, ivec3(p, (p.x + p.y) % 4), vec4(1.0 + float(p.x + 8 * p.y)));
}
