//!HOOK RGB
//!BIND HOOKED
//!DESC swap at the first stage

vec4 hook() {
  return HOOKED_texOff(0).brga;
}

//!HOOK MAIN
//!BIND HOOKED
//!SAVE GREY
//!COMPONENTS 1
//!DESC one channel

vec4 hook() {
  return vec4(dot(HOOKED_texOff(0).rgb, vec3(0.2126, 0.7152, 0.0722)), 0.0, 0.0, 1.0);
}

//!HOOK MAIN
//!BIND HOOKED
//!BIND GREY
//!DESC edges of the grey picture

vec4 hook() {
  vec2 place = GREY_pos;
  float right = GREY_tex(place + vec2(GREY_pt.x, 0.0)).r;
  float below = GREY_tex(place + vec2(0.0, 1.0 / GREY_size.y)).r;
  float here = GREY_mul * texture(GREY_raw, place).r;
  return vec4(abs(right - here) * 2.0, abs(below - here) * 2.0, HOOKED_tex(HOOKED_pos).b, 1.0);
}
