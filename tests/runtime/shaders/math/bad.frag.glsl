// Does not compile.
uniform sampler2D source;
layout(std140) uniform Parameters { float amount; };
out vec4 result;

void main() { result = texelFetch(source, ivec2(0), 0) + ammount; }
