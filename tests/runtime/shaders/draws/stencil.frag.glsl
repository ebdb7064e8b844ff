// read    marks
// write   result
uniform usampler2D marks;
out vec4 result;

void main() { result = vec4(texelFetch(marks, ivec2(gl_FragCoord.xy), 0).r); }
