// params  color
// write   result
layout(std140) uniform Parameters { vec4 color; };
out vec4 result;

void main() { result = color; }
