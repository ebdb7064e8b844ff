//!HOOK LUMA
//!BIND HOOKED
vec4 hook() { return HOOKED_texOff(0); }
