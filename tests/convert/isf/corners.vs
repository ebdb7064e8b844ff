varying vec2 left_of;
varying vec2 right_of;

void main() {
  isf_vertShaderInit();
  vec2 step_ = vec2(amount, 0.0) / RENDERSIZE;
  left_of = isf_FragNormCoord - step_;
  right_of = isf_FragNormCoord + step_;
}
