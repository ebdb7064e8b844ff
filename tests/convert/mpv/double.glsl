//!HOOK MAIN
//!BIND HOOKED
//!WIDTH HOOKED.w 2 *
//!HEIGHT HOOKED.h 2 *
//!DESC twice the size, which the end scales back

vec4 hook() {
  vec2 cell = floor(HOOKED_pos * HOOKED_size * 2.0);
  float checks = mod(cell.x + cell.y, 2.0);
  return mix(HOOKED_tex(HOOKED_pos), vec4(checks, checks, checks, 1.0), 0.5);
}
