// Light from one direction, for surfaces as shading/ibl.glsl has them. Each function gives the radiance that leaves towards V
// for an irradiance of 1 on a surface that faces the light: the BRDF times N.L.
#ifndef SHADING_DIRECT_GLSL
#define SHADING_DIRECT_GLSL

#include "shading/ibl.glsl"

// Cook-Torrance: GGX, Smith's height-correlated masking (Heitz, JCGT 2014), Schlick's Fresnel, and the layers of `response`, so that
// light from everywhere adds up to what the environment's maps give. Mirrors reflect a point as if they were of roughness 0.045.
vec3 cookTorrance(Response response, float roughness, vec3 n, vec3 v, vec3 l) {
  float nl = dot(n, l), nv = max(dot(n, v), 1e-4);
  if (nl <= 0.0) return vec3(0.0);
  float alpha = max(alphaOfRoughness(roughness), 0.002), a2 = alpha * alpha;
  vec3 h = normalize(v + l), nxh = cross(n, h);
  float nh = max(dot(n, h), 0.0), vh = clamp(dot(v, h), 0.0, 1.0);
  float d = nh * nh * a2 + dot(nxh, nxh);  // = (N.H)^2 (a2 - 1) + 1, without cancellation
  float distribution = a2 / (kPi * d * d);
  float masking = 0.5 / (nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2));
  float m = 1.0 - vh, m2 = m * m;
  vec3 fresnel = response.f0 + (1.0 - response.f0) * (m2 * m2 * m);
  return nl * (distribution * masking * fresnel + (response.multiple + response.diffuse) * (1.0 / kPi));
}

// Blinn-Phong: diffuse / pi + specular * N(n) * (N.H)^n, where N(n) = (n + 2) (n + 4) / (8 pi (2^(-n/2) + n)) makes the specular part
// reflect exactly `specular` of what comes from everywhere when it is seen from above, and less from elsewhere (Giesen, "Phong and
// Blinn-Phong normalization factors", 2009). The diffuse part gets what the specular one leaves.
struct Phong {
  vec3 diffuse, specular;
  float exponent;
};
Phong phongOf(Surface surface, float exponent) {
  vec3 specular = mix(vec3(0.04), surface.albedo, surface.metallic);
  return Phong(surface.albedo * (1.0 - surface.metallic) * (1.0 - specular), specular, exponent);
}
vec3 blinnPhong(Phong phong, vec3 n, vec3 v, vec3 l) {
  float nl = dot(n, l), e = phong.exponent;
  if (nl <= 0.0) return vec3(0.0);
  vec3 h = normalize(v + l), nxh = cross(n, h);
  // (N.H)^n by the sine, which is exact where the lobe is narrow.
  float lobe = dot(n, h) > 0.0 ? exp2(0.5 * e * log2(max(1.0 - dot(nxh, nxh), 1e-20))) : 0.0;
  float normalization = (e + 2.0) * (e + 4.0) / (8.0 * kPi * (exp2(-0.5 * e) + e));
  return nl * (phong.diffuse * (1.0 / kPi) + phong.specular * (normalization * lobe));
}

// Exponent and roughness of lobes as wide as each other (Walter et al., EGSR 2007).
float exponentOfRoughness(float roughness) {
  float alpha = max(alphaOfRoughness(roughness), 0.01);
  return max(2.0 / (alpha * alpha) - 2.0, 1.0);
}
float roughnessOfExponent(float exponent) { return sqrt(sqrt(2.0 / (exponent + 2.0))); }

#endif
