// Depth of a ray-traced sphere, for ambient occlusion.
// modify  depth    near / distance along the view axis (reversed-Z)
// define  BACK     1: where the ray leaves the sphere; 0: where it enters
#include "common/view.glsl"

flat in vec4 sphere;

void main() {
  vec2 ndc = gl_FragCoord.xy / viewport * 2.0 - 1.0;
  vec3 ray = vec3((ndc + projection[2].xy) / vec2(projection[0].x, projection[1].y), -1.0), c = sphere.xyz, apart = cross(c, ray);
  float length2 = dot(ray, ray), root2 = sphere.w * sphere.w * length2 - dot(apart, apart);
  float distance_to = (dot(c, ray) + (BACK == 1 ? 1.0 : -1.0) * sqrt(max(root2, 0.0))) / length2;
  if (root2 < 0.0 || distance_to < near_plane) discard;
  gl_FragDepth = near_plane / distance_to;
}
