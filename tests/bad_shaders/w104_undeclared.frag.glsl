#include "parts/undeclared.glsl"
out vec4 result;
void main() { result = vec4(scaled(1.0)); }
