// A View block with a member that no view has.
uniform sampler2D source;
layout(std140) uniform View { vec3 eye; float near_plain; };
out vec4 result;

void main() { result = texelFetch(source, ivec2(gl_FragCoord.xy), 0) + vec4(eye, near_plain); }
