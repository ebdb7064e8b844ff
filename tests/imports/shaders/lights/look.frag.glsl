// How much deeper the sun's map is at a point than the point itself.
// read    sun       @sun
//         sun_map
// params  at        world
struct Sun { mat4 shadow_matrix; };
layout(std430) readonly buffer sun { Sun sun_row[]; };
uniform sampler2D sun_map;
layout(std140) uniform Parameters { vec3 at; };
out float shadow;

void main() {
  vec4 place = sun_row[0].shadow_matrix * vec4(at, 1.0);
  shadow = texture(sun_map, place.xy).r - place.z;
}
