//!HOOK MAIN
//!BIND HOOKED
//!WIDTH HOOKED.w *
vec4 hook() { return vec4(1.0); }
