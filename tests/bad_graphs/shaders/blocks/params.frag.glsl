// The block of the parameters has another name than Parameters.
layout(std140) uniform Params { float gain; vec3 tint; };
out vec4 result;

void main() { result = vec4(tint * gain, 1.0); }
