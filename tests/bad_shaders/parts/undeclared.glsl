// A mistake inside an include.
float scaled(float value) {
  return value * scael;
}
