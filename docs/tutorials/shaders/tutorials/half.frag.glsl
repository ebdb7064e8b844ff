// A level of half the size: each texel is the mean of the four below it, which one linear lookup gives (of even sides, exactly).
// read    source   the level before
// write   result   this level
uniform sampler2D source;
in vec2 uv;
out vec4 result;

void main() { result = textureLod(source, uv, 0.0); }
