// Four pictures of one size side by side, unchanged, so that a test can read them from one texture.
// read    a, b, c, d   any sampler (texels are fetched)
// write   result       four times as wide
uniform sampler2D a, b, c, d;
out vec4 result;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  int width = textureSize(a, 0).x, panel = at.x / width;
  at.x -= panel * width;
  result = panel == 0 ? texelFetch(a, at, 0) : panel == 1 ? texelFetch(b, at, 0)
         : panel == 2 ? texelFetch(c, at, 0) : texelFetch(d, at, 0);
}
