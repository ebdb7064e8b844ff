// read    plain, least, below, same, most, above, other, all, nothing, lit   depths of 0.25, 0.5, 0.75, 1
// write   first, second, third   0.5 held against them, at the middles of the texels -1 to 4
uniform sampler2DShadow plain, least, below, same, most, above, other, all, nothing, lit;
layout(location = 0) out vec4 first;
layout(location = 1) out vec4 second;
layout(location = 2) out vec4 third;

void main() {
  vec3 at = vec3((gl_FragCoord.x - 1.0) / 4.0, 0.5, 0.5);
  first = vec4(texture(plain, at), texture(least, at), texture(below, at), texture(same, at));
  second = vec4(texture(most, at), texture(above, at), texture(other, at), texture(all, at));
  third = vec4(texture(nothing, at), texture(lit, at), 0.0, 0.0);
}
