//!TEXTURE TABLE
//!SIZE 2 2
//!FORMAT rgba8
ff00ff00

//!HOOK MAIN
//!BIND TABLE
vec4 hook() { return texture(TABLE, vec2(0.5)); }
