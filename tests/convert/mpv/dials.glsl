//!PARAM gain
//!DESC Gain
//!TYPE float
//!MINIMUM 0.0
//!MAXIMUM 2.0
0.5

//!HOOK MAIN
//!HOOK LUMA
//!BIND HOOKED
//!DESC a parameter, sizes and the number of the frame

vec4 hook() {
  vec4 color = HOOKED_tex(HOOKED_pos);
  float stripe = mod(floor(HOOKED_pos.x * input_size.x), 4.0) < 2.0 ? 1.0 : gain;
  return vec4(color.rgb * stripe * float(frame + 1), 1.0);
}
