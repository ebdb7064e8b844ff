// Takes a whole number.
uniform sampler2D source;
layout(std140) uniform Parameters { int steps; };
out vec4 result;

void main() { result = texelFetch(source, ivec2(gl_FragCoord.xy), 0) / float(steps); }
