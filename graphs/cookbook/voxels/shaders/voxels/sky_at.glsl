// Sky and ground, as blurred as a cone that is `open` wide at distance 1 sees them.
vec3 skyAt(vec3 d, float open) {
  vec3 sky = mix(vec3(0.4, 0.45, 0.52), vec3(0.14, 0.27, 0.55), sqrt(max(d.y, 0.0)));
  return mix(vec3(0.12, 0.11, 0.1), sky, smoothstep(-0.5 * open, 0.5 * open, d.y));
}
