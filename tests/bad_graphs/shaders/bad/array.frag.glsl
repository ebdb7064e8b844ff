// Weights that the pass does not set.
layout(std140) uniform Parameters { vec4 weights[4]; };
out vec4 result;

void main() { result = weights[int(gl_FragCoord.x) & 3]; }
