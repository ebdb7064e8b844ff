// A point that is shaded, and the light that arrives there.
#ifndef SHADING_POINT_GLSL
#define SHADING_POINT_GLSL

#if defined HAS_PROBE_LIGHT && defined HAS_PROBE_DEPTH && defined HAS_PROBE_BACKS && defined HAS_PROBE_PLACE
#define SEES_PROBE 1
#else
#define SEES_PROBE 0
#endif
#if defined HAS_SPECULAR && (defined HAS_MIRRORED || defined HAS_MIRROR_LIGHT || SEES_PROBE)
#define SEES_SCENE 1
#else
#define SEES_SCENE 0
#endif

struct Point {
  vec3 position;      // world
  vec3 normal;        // unit, towards the viewer's side
  vec3 to_eye;        // unit
  vec3 mirror;        // to_eye, reflected at the surface
  float nv;           // cosine between normal and to_eye, 0..1
  float sky_visible;  // share of the environment that ambient occlusion leaves
};

// Light of the environment that arrives at a point.
struct Ambient {
  vec3 reflected;  // radiance that leaves towards the eye by single scattering
  vec3 mean;       // irradiance over pi
#if SEES_SCENE
  vec3 traced;     // radiance towards the eye of what the lobe meets of the scene
  float open;      // share of the lobe that meets nothing; `reflected` is that of the whole lobe
#endif
};

#if SEES_SCENE
Ambient noAmbient() { return Ambient(vec3(0.0), vec3(0.0), vec3(0.0), 1.0); }

// Radiance towards the eye. What a lobe meets is not occluded once more: of the environment's light arrives what ambient occlusion leaves
// of it, `visible`, or what rays leave, whichever is less.
vec3 ambientWithScene(Ambient ambient, vec3 multiple, vec3 diffuse, float lobe_visible, float visible) {
  return ambient.traced + ambient.reflected * min(lobe_visible, ambient.open) +
         (multiple * min(visible, ambient.open) + diffuse * visible) * ambient.mean;
}
#else
Ambient noAmbient() { return Ambient(vec3(0.0), vec3(0.0)); }
#endif

// The visible shares of lights far away: the sun, and the environment's brightest spots.
struct LightsSeen {
  float sun, spot;
  vec3 others;
};
const LightsSeen kOpen = LightsSeen(1.0, 1.0, vec3(1.0));
float otherOf(LightsSeen seen, int i) { return i < 2 ? seen.others.x : i < 3 ? seen.others.y : seen.others.z; }

#endif
