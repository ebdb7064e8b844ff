// Where rows are counted from, and the plainest use of what is hooked.
//!HOOK MAIN
//!BIND HOOKED
//!DESC tint by place

vec4 hook() {
  vec4 color = HOOKED_tex(HOOKED_pos);
  return vec4(color.r * HOOKED_pos.x, color.g * HOOKED_pos.y, 1.0 - color.b, color.a);
}
