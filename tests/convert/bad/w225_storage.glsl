//!BUFFER seen
vec4 light;

//!HOOK MAIN
//!BIND HOOKED
vec4 hook() { return HOOKED_tex(HOOKED_pos) + light; }
