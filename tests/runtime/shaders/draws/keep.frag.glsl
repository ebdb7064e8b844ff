// Two textures at one place: red of each, in one texel.
// read    texels
// write   result
uniform sampler2D texels[2];
out vec4 result;

void main() {
  result = vec4(texelFetch(texels[0], ivec2(8), 0).r, texelFetch(texels[1], ivec2(8), 0).r, 0.0, 0.0);
}
