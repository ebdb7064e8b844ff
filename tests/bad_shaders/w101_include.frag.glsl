// The name of the included file is misspelt.
out vec4 result;
#include "parts/veiw.glsl"
void main() { result = vec4(1); }
