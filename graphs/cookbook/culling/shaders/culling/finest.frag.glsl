// Level 0: depth; beside the picture, what hides all.
// read    depth      reversed-Z: less is farther
// write   farthest
uniform sampler2D depth;
out float farthest;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  farthest = all(lessThan(at, textureSize(depth, 0))) ? texelFetch(depth, at, 0).r : 1.0;
}
