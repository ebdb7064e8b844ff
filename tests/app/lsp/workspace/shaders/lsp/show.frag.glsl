#include "lsp/read.glsl"
uniform sampler2D extra;
out vec4 result;

void main() {
  result = texel();
#ifdef HAS_EXTRA
  result += texelFetch(extra, ivec2(gl_FragCoord.xy), 0);
#endif
}
