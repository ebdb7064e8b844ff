// Takes a vec2 where the vertex shader gives a vec3.
in vec2 uv;
out vec4 result;
void main() { result = vec4(uv, 0, 1); }
