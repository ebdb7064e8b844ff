//!HOOK MAIN
//!BIND HOOKED
//!OFFSET 1.0 -2.0
//!DESC moves the picture, and says so

vec4 hook() {
  return HOOKED_texOff(vec2(-1.0, 2.0));
}
