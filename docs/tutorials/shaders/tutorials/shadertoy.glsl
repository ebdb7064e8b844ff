// What Shadertoy calls by other names. To be included before the text of a toy, whose pass writes `fragColor`.
#include "common/view.glsl"

#define iTime time
#define iTimeDelta delta_time
#define iFrame int(frame)
#define iResolution vec3(viewport, 1.0)

#ifdef HAS_MOUSE
#include "common/mouse.glsl"
#define iMouse shadertoyMouse()
#endif

out vec4 fragColor;
void mainImage(out vec4 fragColor, in vec2 fragCoord);
void main() { mainImage(fragColor, gl_FragCoord.xy); }
