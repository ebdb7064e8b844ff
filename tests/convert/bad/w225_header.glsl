//!HOOK MAIN
//!BINDS HOOKED
vec4 hook() { return vec4(1.0); }
