// Pictures of decals, in -1..1: how much of the color, 0..1.
float soft(float inside) { return clamp(inside / max(fwidth(inside), 1e-4) + 0.5, 0.0, 1.0); }

float hash(vec2 p) { return fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.5453); }
float noise(vec2 p) {
  vec2 i = floor(p), f = fract(p), s = f * f * (3.0 - 2.0 * f);
  return mix(mix(hash(i), hash(i + vec2(1, 0)), s.x), mix(hash(i + vec2(0, 1)), hash(i + vec2(1, 1)), s.x), s.y);
}

float target(vec2 p) { return max(soft(0.1 - abs(length(p) - 0.8)), max(soft(0.08 - abs(length(p) - 0.45)), soft(0.15 - length(p)))); }
float stripes(vec2 p) { return soft(0.45 - abs(p.y)) * soft(0.95 - abs(p.x)) * soft(0.25 - abs(fract(2.5 * (p.x + p.y)) - 0.5)); }
float splash(vec2 p) { return soft(0.75 - length(p) - 0.5 * (noise(4.0 * p + 7.0) - 0.3) - 0.2 * (noise(11.0 * p) - 0.5)); }

float picture(int which, vec2 p) { return which == 0 ? target(p) : which == 1 ? stripes(p) : splash(p); }
