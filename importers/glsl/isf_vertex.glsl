// Where @NAME@ draws. The lines of @NAME@.vs.glsl are those of the ISF file.
out vec2 isf_FragNormCoord;
void isf_vertShaderInit() {
  isf_FragNormCoord = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(isf_FragNormCoord * 2.0 - 1.0, 0.0, 1.0);
}
#include "isf.glsl"
#include "@NAME@.vs.glsl"
