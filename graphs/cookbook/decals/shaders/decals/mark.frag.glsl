// Writes nothing: the stencil counts.
// modify  depth   only its stencil
flat in int decal;

void main() {}
