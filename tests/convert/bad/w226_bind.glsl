//!HOOK MAIN
//!BIND HOOKED
//!BIND BLURRED
vec4 hook() { return BLURRED_texOff(0); }
