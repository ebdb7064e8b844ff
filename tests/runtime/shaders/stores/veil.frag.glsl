// write   result   one quarter
out vec4 result;

void main() { result = vec4(0.25); }
