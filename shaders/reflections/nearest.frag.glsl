// In each cell the greatest depth of the four below it, or of two where the picture ends.
// read    finer     the picture's depth, or the level below
// write   nearest
uniform sampler2D finer;
out float nearest;

void main() {
  ivec2 last = textureSize(finer, 0) - 1, a = min(2 * ivec2(gl_FragCoord.xy), last), b = min(a + 1, last);
  nearest = max(max(texelFetch(finer, a, 0).r, texelFetch(finer, ivec2(b.x, a.y), 0).r),
                max(texelFetch(finer, ivec2(a.x, b.y), 0).r, texelFetch(finer, b, 0).r));
}
