//!HOOK MAIN
//!BIND HOOKED
//!WHEN OUTPUT.w HOOKED.w 1.5 * >
//!DESC only when the picture is enlarged

vec4 hook() {
  return vec4(1.0, 0.0, 0.0, 1.0);
}

//!HOOK MAIN
//!BIND HOOKED
//!WHEN HOOKED.w HOOKED.h > OUTPUT.h 10 > *
//!DESC only for wide pictures

vec4 hook() {
  return HOOKED_tex(HOOKED_pos).grba;
}
