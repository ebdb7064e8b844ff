// read    a, b      numbers, in their texels 0, 0
// write   result    both
uniform sampler2D a, b;
out vec2 result;

void main() { result = vec2(texelFetch(a, ivec2(0), 0).r, texelFetch(b, ivec2(0), 0).r); }
