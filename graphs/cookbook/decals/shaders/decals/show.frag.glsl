// A tint where the stencil is set. Blended by alpha.
// read    mask     stencil
// modify  result   encoded picture
out vec4 result;

void main() { result = vec4(0.1, 1.0, 0.4, 0.35); }
