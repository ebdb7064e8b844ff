#include "cycle_a.glsl"
float b() { return 2.0; }
