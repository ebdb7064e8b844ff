// What is the same for all pixels of composite.frag.glsl, for SETTINGS_ARE_FLAT.
#include "common/fullscreen.glsl"
#include "settings.glsl"

noperspective out vec2 uv;
flat out Settings settings;

void main() {
  settings = settingsOf();
  gl_Position = fullscreenPosition(uv);
}
