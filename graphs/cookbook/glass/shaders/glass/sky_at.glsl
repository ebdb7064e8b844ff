// A sky with a softbox.
vec3 skyAt(vec3 d) {
  vec3 sky = d.y > 0.0 ? mix(vec3(0.7, 0.72, 0.75), vec3(0.2, 0.35, 0.7), sqrt(d.y)) : mix(vec3(0.5, 0.47, 0.44), vec3(0.12, 0.1, 0.09), sqrt(-d.y));
  vec3 box = vec3(d.xy / max(d.z, 1e-3) - vec2(-0.6, 0.9), d.z);
  return sky + (box.z > 0.0 && max(abs(box.x), abs(box.y)) < 0.35 ? 6.0 : 0.0);
}
