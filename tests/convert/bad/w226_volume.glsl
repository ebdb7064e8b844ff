//!TEXTURE TABLE
//!SIZE 1 1 2
//!FORMAT r8
00ff

//!HOOK MAIN
//!BIND TABLE
vec4 hook() { return vec4(1.0); }
