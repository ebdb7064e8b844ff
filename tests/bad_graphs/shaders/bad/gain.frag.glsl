// Fills with a parameter.
layout(std140) uniform Parameters { float gain; };
out vec4 result;

void main() { result = vec4(gain); }
