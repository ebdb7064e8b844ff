// write   result
out vec4 result;

void main() { result = vec4(5.0); }
