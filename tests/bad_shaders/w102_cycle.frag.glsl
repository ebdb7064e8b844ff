// Two parts that include each other.
#include "parts/cycle_a.glsl"
out vec4 result;
void main() { result = vec4(a()); }
