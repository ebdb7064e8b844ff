// Real spherical harmonics up to band 2, and the coefficients of a cap. Order: Y00, Y1-1 (y), Y10 (z), Y11 (x), Y2-2 (xy), Y2-1 (yz),
// Y20 (3zz - 1), Y21 (xz), Y22 (xx - yy), as in Ramamoorthi and Hanrahan, "An Efficient Representation for Irradiance Environment
// Maps", SIGGRAPH 2001.
#ifndef GI_SH_GLSL
#define GI_SH_GLSL

const float kShPi = 3.14159265358979;

// The functions in a unit direction.
void shBasis(vec3 d, out float y[9]) {
  y[0] = 0.282094792;
  y[1] = 0.488602512 * d.y;
  y[2] = 0.488602512 * d.z;
  y[3] = 0.488602512 * d.x;
  y[4] = 1.092548431 * d.x * d.y;
  y[5] = 1.092548431 * d.y * d.z;
  y[6] = 0.315391565 * (3.0 * d.z * d.z - 1.0);
  y[7] = 1.092548431 * d.x * d.z;
  y[8] = 0.546274215 * (d.x * d.x - d.y * d.y);
}

// Bands of radiance 1 in a cone whose half angle has this sine: coefficient (l, m) is component l times Y_lm of its axis.
vec3 capBands(float sine) {
  float square = min(sine * sine, 1.0), cosine = sqrt(1.0 - square);
  return vec3(2.0 * kShPi * square / (1.0 + cosine), kShPi * square, kShPi * square * cosine);
}

// The same of a point that lights a surface facing it as much.
vec3 pointBands(float sine) { return vec3(kShPi * min(sine * sine, 1.0)); }

// The factors by which irradiance has each band of the radiance (Ramamoorthi and Hanrahan, SIGGRAPH 2001).
const vec3 kCosineLobe = vec3(kShPi, kShPi * 2.0 / 3.0, kShPi / 4.0);

#endif
