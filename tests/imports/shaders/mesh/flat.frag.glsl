// The albedo of what is on top.
// read    materials  @materials
// modify  seen, depth
#include "scene/materials.glsl"

flat in uint row;
out vec4 seen;

void main() { seen = vec4(material[row].albedo, 1.0); }
