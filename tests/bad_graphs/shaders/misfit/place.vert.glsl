// A vertex shader for W187 with an input that no geometry has.
in vec3 postion;

void main() { gl_Position = vec4(postion, 1.0); }
