// Weights that the pass does not set, with the size behind the type.
layout(std140) uniform Parameters { vec4[4] weights; };
out vec4 result;

void main() { result = weights[int(gl_FragCoord.x) & 3]; }
