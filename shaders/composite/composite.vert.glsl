// Computes the values of composite.frag.glsl that are the same for all pixels, for SETTINGS_ARE_FLAT.
#include "common/fullscreen.glsl"
#include "settings.glsl"

noperspective out vec2 uv;
flat out Settings settings;

void main() {
  settings = settingsOf();
  gl_Position = fullscreenPosition(uv);
}
