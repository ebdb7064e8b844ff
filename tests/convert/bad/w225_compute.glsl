//!HOOK MAIN
//!BIND HOOKED
//!COMPUTE 8
void hook() {}
