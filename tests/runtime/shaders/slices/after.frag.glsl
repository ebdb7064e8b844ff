// What a pass outside the group, on_change, makes of what the group published.
uniform sampler2D field;
layout(std430) readonly buffer total { vec4 sum; };
out vec4 result;

void main() { result = vec4(texelFetch(field, ivec2(0), 0).x * 1000.0 + sum.x); }
