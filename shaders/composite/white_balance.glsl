// White balance, scene-referred: adapts the picture from the light on the scene to D65, the white of sRGB.
// temperature  of that light in K, 2000..15000. A higher value says that the light was bluer, so the picture becomes warmer
// tint         -100..100. A value above 0 says that the light was greener, so the picture becomes more magenta; 1 is 0.0003 Duv
//              across the locus
// Lights lie on the black-body locus (Krystek, "An algorithm to calculate correlated color temperature", 1985; CIE 1960 uv),
// moved by the constant that brings it through D65 at 6504 K: there, with tint 0, nothing changes. Adaptation: Bradford.
#ifndef COMPOSITE_WHITE_BALANCE_GLSL
#define COMPOSITE_WHITE_BALANCE_GLSL

vec2 locusUv(float kelvin) {
  return vec2((0.860117757 + kelvin * (1.54118254e-4 + kelvin * 1.28641212e-7)) /
                  (1.0 + kelvin * (8.42420235e-4 + kelvin * 7.08145163e-7)),
              (0.317398726 + kelvin * (4.22806245e-5 + kelvin * 4.20481691e-8)) /
                  (1.0 + kelvin * (-2.89741816e-5 + kelvin * 1.61456053e-7)));
}

vec2 lightUv(float kelvin, float tint) {
  vec2 locus = locusUv(kelvin), bluer = normalize(locusUv(1.02 * kelvin) - locusUv(kelvin / 1.02));
  return locus + vec2(-0.002644032, 0.001917705) + 0.0003 * tint * vec2(bluer.y, -bluer.x);
}

vec3 whiteBalance(vec3 color, float kelvin, float tint) {
  const mat3 bradford = mat3(0.8951, -0.7502, 0.0389, 0.2664, 1.7135, -0.0685, -0.1614, 0.0367, 1.0296);
  // Bradford's matrix times linear sRGB to XYZ, and its inverse.
  const mat3 to_cone = mat3(0.422658041, 0.055690800, 0.021379241, 0.491356641, 0.961556208, 0.087643922, 0.027364497,
                            0.023189375, 0.980743433);
  const mat3 from_cone = mat3(2.538447974, -0.146000365, -0.042288376, -1.293482568, 1.116622407, -0.071590070,
                              -0.040243247, -0.022328520, 1.022507310);
  vec2 at = lightUv(kelvin, tint);
  vec3 light = vec3(1.5 * at.x / at.y, 1.0, (4.0 - at.x - 10.0 * at.y) / (2.0 * at.y));  // XYZ with Y = 1
  vec3 gain = (to_cone * vec3(1.0)) / max(bradford * light, vec3(1e-3));
  return from_cone * (gain * (to_cone * color));
}

#endif
