//!DESC nothing is hooked
//!BIND HOOKED
vec4 hook() { return vec4(1.0); }
