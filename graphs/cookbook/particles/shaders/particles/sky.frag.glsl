// write   result   encoded picture
in vec2 uv;
out vec4 result;

void main() { result = vec4(mix(vec3(0.16, 0.13, 0.17), vec3(0.04, 0.05, 0.1), uv.y), 1.0); }
