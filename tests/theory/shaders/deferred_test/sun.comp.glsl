// A sun whose shadow map covers 16 x 16 world units about the origin and 32 along its direction.
// write   sun         see scene/sun.glsl
// params  direction   towards it
//         irradiance
//         angle       degrees it is seen under
//         texels      of the map, along a side
layout(local_size_x = 1) in;
struct Sun {
  vec3 direction;
  float cos_angle;
  vec3 irradiance;
  float texel;
  mat4 shadow_matrix;
};
layout(std430) writeonly buffer sun { Sun light; };
layout(std140) uniform Parameters {
  vec3 direction;
  vec3 irradiance;
  float angle;
  float texels;
};

void main() {
  vec3 d = normalize(direction), right = normalize(cross(vec3(0.0, 0.0, -1.0), d)), up = cross(d, right);
  light.direction = d;
  light.cos_angle = cos(radians(0.5 * angle));
  light.irradiance = irradiance;
  light.texel = 16.0 / texels;
  light.shadow_matrix = transpose(mat4(vec4(right / 16.0, 0.5), vec4(up / 16.0, 0.5), vec4(d / 32.0, 0.5), vec4(0.0, 0.0, 0.0, 1.0)));
}
