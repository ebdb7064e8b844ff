// params  rect, color, height, back
// write   result
layout(std140) uniform Parameters { vec4 rect, color; float height, back; };
out vec4 result;

void main() { result = color; }
