vec3 skyAt(vec3 d) { return mix(vec3(0.85, 0.72, 0.58), vec3(0.3, 0.5, 0.75), sqrt(clamp(d.y, 0.0, 1.0))); }
