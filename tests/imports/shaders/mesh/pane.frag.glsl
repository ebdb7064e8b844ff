// The albedo of a pane, as much of it as covers what is behind.
// read    materials  @materials
// modify  seen
#include "scene/materials.glsl"

flat in uint row;
out vec4 seen;

void main() { seen = vec4(material[row].albedo, 1.0) * material[row].alpha; }
