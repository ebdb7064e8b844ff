// Fills the fog constants, for all shaders that include fog/fog.glsl.
// write   air           buffer of 32 bytes
// params  fog_color     radiance of endless fog
//         fog_density   extinction per world unit at the height `fog_base`
//         fog_falloff   in 1 / fog_falloff world units of height the extinction falls to 1/e; 0: it is the same everywhere
//         fog_base      world units
//         fog_layer     world units above and below the eye at which the fog in front of the sky ends; below, at `fog_base` if that is lower
//         fog_sky       weight of that layer
layout(local_size_x = 1) in;

layout(std430) writeonly buffer air {
  vec4 light;
  vec4 shape;
};
layout(std140) uniform Parameters {
  vec3 fog_color;
  float fog_density;
  float fog_falloff;
  float fog_base;
  float fog_layer;
  float fog_sky;
};

void main() {
  float at_0 = fog_density > 0.0 ? log(fog_density) + fog_falloff * fog_base : -1e30;
  light = vec4(fog_color, fog_base);
  shape = vec4(fog_falloff, fog_layer, fog_sky, at_0);
}
