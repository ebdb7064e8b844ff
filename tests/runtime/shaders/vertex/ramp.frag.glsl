// write   result
in vec2 uv;
flat in float whole;
out vec4 result;

void main() { result = vec4(uv, whole, 1.0); }
