// write   result
flat in float value;
out vec4 result;

void main() { result = vec4(value); }
