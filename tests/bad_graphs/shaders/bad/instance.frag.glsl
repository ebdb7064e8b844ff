// A member of a block with an instance name, without that name.
uniform sampler2D source;
layout(std140) uniform Parameters { float gain; } params;
out vec4 result;

void main() { result = gain * texelFetch(source, ivec2(gl_FragCoord.xy), 0); }
