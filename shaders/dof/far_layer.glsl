// The far field that far_bokeh and far_hidden read.
// read    source   from split, layer 1, with levels, `as linear`
//         discs    from split, with levels, `as linear`
//         flat_source, flat_discs   instead of these, without levels, when no disc needs them: see the graph
#ifndef DOF_FAR_LAYER_GLSL
#define DOF_FAR_LAYER_GLSL

#define NEAR 0
#ifdef HAS_FLAT_SOURCE
#define source flat_source
#define discs flat_discs
#define COARSEST 0.0
#endif
uniform sampler2D source, discs;

#endif
