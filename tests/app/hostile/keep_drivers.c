// Preloaded by sanitize.sh: nothing is unloaded, so that LeakSanitizer can name the module of each leak at exit. EGL and GLX
// unload their driver before that, and its leaks would have no module to be excepted by (tests/gl/lsan.supp).
int dlclose(void* handle) {
  (void)handle;
  return 0;
}
