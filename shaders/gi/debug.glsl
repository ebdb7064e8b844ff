// Parameters of the two stages of gi/debug.
layout(std140) uniform Parameters {
  float size;
  float gain;
  float sky_turn;
};
