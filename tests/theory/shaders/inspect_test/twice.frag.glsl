// read    source
// write   result   twice the source
uniform sampler2D source;
out vec4 result;

void main() { result = 2.0 * texelFetch(source, ivec2(gl_FragCoord.xy), 0); }
