// Multiplies by a colour.
uniform sampler2D source;
layout(std140) uniform Parameters { vec3 tint; };
out vec4 result;

void main() { result = texelFetch(source, ivec2(gl_FragCoord.xy), 0) * vec4(tint, 1.0); }
