// Level 0: depth, and nothing beside the picture.
// read    depth     reversed-Z: more is nearer
// write   nearest
uniform sampler2D depth;
out float nearest;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  nearest = all(lessThan(at, textureSize(depth, 0))) ? texelFetch(depth, at, 0).r : 0.0;
}
