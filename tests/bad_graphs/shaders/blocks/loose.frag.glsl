// A uniform outside of a block.
uniform float gain;
out vec4 result;

void main() { result = vec4(gain); }
