// A copy.
// read    source   any sampler (texels are fetched)
// write   result   the same size
uniform sampler2D source;
out vec4 result;

void main() { result = texelFetch(source, ivec2(gl_FragCoord.xy), 0); }
