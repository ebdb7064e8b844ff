// The box of a decal.
#include "common/view.glsl"
#include "boxes.glsl"

in vec3 position;
flat out int decal;

void main() {
  decal = gl_InstanceID;
  gl_Position = view_projection * vec4(places[decal].xyz + boxAxes(decal) * position * places[decal].w, 1.0);
}
