// The mean of this frame and those before.
// read   seen, before  sum@-1
// write  result
uniform sampler2D seen, before;
out vec4 result;

void main() { result = mix(texelFetch(seen, ivec2(gl_FragCoord.xy), 0), texelFetch(before, ivec2(gl_FragCoord.xy), 0), 0.5); }
