// The block Parameters of shaders that light surfaces, the same in both stages.
// params  sky_turn?     rotation of the environment, in full turns
//         lamp_count    with lamps
#ifndef SHADING_PARAMETERS_GLSL
#define SHADING_PARAMETERS_GLSL

#if defined HAS_SKY_TURN || defined HAS_LAMPS
layout(std140) uniform Parameters {
#ifdef HAS_SKY_TURN
  float sky_turn;
#endif
#ifdef HAS_LAMPS
  int lamp_count;
#endif
};
#endif

#endif
