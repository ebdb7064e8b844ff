//!PARAM taps
//!TYPE DEFINE
//!MINIMUM 1
//!MAXIMUM 8
4

//!HOOK MAIN
//!BIND HOOKED
vec4 hook() { return HOOKED_tex(HOOKED_pos) * float(taps); }
