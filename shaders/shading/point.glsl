// A point that is shaded, and the light that arrives there.
#ifndef SHADING_POINT_GLSL
#define SHADING_POINT_GLSL

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
};

// The visible shares of two lights far away: the sun, and the environment's brightest spot.
struct LightsSeen {
  float sun, spot;
};

#endif
