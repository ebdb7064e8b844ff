// A spot of the environment that stands out, and how far around it the map is cut.
#ifndef IBL_SPOT_GLSL
#define IBL_SPOT_GLSL

struct Spot {
  vec4 at;     // towards it, in the map's own orientation; w: radiance above which it was cut out of the map, the same for all
  vec4 light;  // irradiance that was cut out, on a surface facing it; w: its variance along one axis, radians squared
};
const int kSpots = 4;               // at most; those that a map has are the first, the others have no light
const float kWindow = 0.0873;       // radians around the spot that are cut: 5 degrees
const float kNearCosine = 0.98481;  // of twice as much
const Spot kNoSpot = Spot(vec4(0.0, 1.0, 0.0, 65504.0), vec4(0.0));  // nothing is cut out

#endif
