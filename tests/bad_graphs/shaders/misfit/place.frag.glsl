// Beside place.vert.glsl.
out vec4 result;

void main() { result = vec4(1.0); }
