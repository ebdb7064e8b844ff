// A sky that is brighter towards the sun. Behind `sunlight` and scene/sun.glsl.
vec3 skyAt(vec3 d) {
  vec3 sky = mix(vec3(0.62, 0.6, 0.6), vec3(0.12, 0.25, 0.55), sqrt(max(d.y, 0.0)));
  return sky + 0.08 * sunlight * pow(max(dot(d, sun_light[0].direction), 0.0), 8.0);
}
