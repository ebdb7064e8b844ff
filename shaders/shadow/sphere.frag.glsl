// Depth alone.
// modify  depth  reversed-Z
void main() {}
