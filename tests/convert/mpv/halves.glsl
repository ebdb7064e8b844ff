//!HOOK MAIN
//!BIND HOOKED
//!SAVE HALF
//!WIDTH HOOKED.w 2 /
//!HEIGHT HOOKED.h 2 /
//!DESC half the size

vec4 hook() {
  return HOOKED_tex(HOOKED_pos);
}

//!HOOK MAIN
//!BIND HOOKED
//!BIND HALF
//!DESC what half the size loses

vec4 hook() {
  vec4 low = HALF_tex(HALF_pos);
  vec4 here = HOOKED_tex(HOOKED_pos);
  return vec4(0.5 + (here.rgb - low.rgb), 1.0);
}
