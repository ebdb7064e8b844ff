// The block of the parameters has another name than Parameters.
layout(std140) uniform Params { float gain; };
out vec4 result;

void main() { result = vec4(vec3(gain), 1.0); }
