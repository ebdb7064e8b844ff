// The unit of frame costs: one linear lookup per pixel.
// read    source   `as linear`
// write   result
uniform sampler2D source;
in vec2 uv;
out vec4 result;

void main() { result = textureLod(source, uv, 0.0); }
