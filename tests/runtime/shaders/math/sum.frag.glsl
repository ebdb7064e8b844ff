// read    a, b, c?   numbers, in their texels 0, 0
// write   result     their sum
uniform sampler2D a, b;
#ifdef HAS_C
uniform sampler2D c;
#endif
out vec4 result;

void main() {
  result = texelFetch(a, ivec2(0), 0) + texelFetch(b, ivec2(0), 0);
#ifdef HAS_C
  result += texelFetch(c, ivec2(0), 0);
#endif
}
