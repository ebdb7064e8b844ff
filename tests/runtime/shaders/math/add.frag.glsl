// read    source   a number, in its texel 0, 0
// write   result   source + amount
// params  amount
uniform sampler2D source;
layout(std140) uniform Parameters { float amount; };
out vec4 result;

void main() { result = texelFetch(source, ivec2(0), 0) + amount; }
