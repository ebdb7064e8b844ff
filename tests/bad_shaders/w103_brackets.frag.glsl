// Only double quotes name a file.
#include <parts/view.glsl>
out vec4 result;
void main() { result = vec4(1); }
