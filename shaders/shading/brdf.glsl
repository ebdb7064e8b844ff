// Light from one direction. Each function gives the radiance that leaves towards the eye for an irradiance of 1 on a surface that faces the
// light: the BRDF times N.L. `n`, `v` and `l` are unit: normal, towards the eye, towards the light.
#ifndef SHADING_BRDF_GLSL
#define SHADING_BRDF_GLSL

#include "common/equirect.glsl"
#include "shading/material.glsl"

float light_radius = 0.0;  // of the disc that the light is, radians; set by shading/sun.glsl while it asks

// Cook-Torrance: GGX, Smith's height-correlated masking (Heitz, JCGT 2014), Schlick's Fresnel, and the layers of `response`, so that
// light from everywhere adds up to what the environment's maps give. Of a disc the point nearest to the mirrored eye counts (Karis, "Real
// shading in Unreal Engine 4", SIGGRAPH 2013 courses), as far from its middle as the disc is wider than the lobe; the lobe around such a
// plateau is divided by its integral.
vec3 cookTorrance(Response response, vec3 n, vec3 v, vec3 l) {
  float nl = dot(n, l), nv = max(dot(n, v), 1e-4);
  if (nl <= 0.0) return vec3(0.0);
  float alpha = light_radius > 0.0 ? max(alphaOfRoughness(response.roughness), 0.25 * LEAST_ALPHA) : alphaUnderLamps(response.roughness);
  float a2 = alpha * alpha, wide = 0.5 * light_radius / (alpha * sqrt(max(nv, 0.02))), part = wide / (1.0 + wide), plateau = wide * part;
  vec3 mirror = reflect(-v, n), aside = mirror - dot(mirror, l) * l;
  vec3 h = normalize(v + normalize(l + aside * min(light_radius * part * inversesqrt(max(dot(aside, aside), 1e-12)), 1.0))), nxh = cross(n, h);
  float nh = max(dot(n, h), 0.0), vh = clamp(dot(v, h), 0.0, 1.0);
  float d = nh * nh * a2 + dot(nxh, nxh);  // = (N.H)^2 (a2 - 1) + 1, without cancellation
  float distribution = a2 / (kPi * d * d * (1.0 + plateau * (plateau + 0.5 * kPi)));
  float masking = 0.5 / (nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2));
  float m = 1.0 - vh, m2 = m * m;
  vec3 fresnel = response.f0 + (response.f90 - response.f0) * (m2 * m2 * m);
  return nl * (distribution * masking * fresnel + (response.multiple + response.diffuse) * (1.0 / kPi));
}

// Blinn-Phong: diffuse / pi + specular * N(n) * (N.H)^n, where N(n) = (n + 2) (n + 4) / (8 pi (2^(-n/2) + n)) makes the specular part
// reflect exactly `specular` of uniform light when it is seen from above, and less from elsewhere (Giesen, "Phong and Blinn-Phong
// normalization factors", 2009).
vec3 blinnPhong(Response response, vec3 n, vec3 v, vec3 l) {
  float nl = dot(n, l), e = response.exponent;
  if (nl <= 0.0) return vec3(0.0);
  vec3 h = normalize(v + l), nxh = cross(n, h);
  // (N.H)^n by the sine, which is exact where the lobe is narrow.
  float lobe = dot(n, h) > 0.0 ? exp2(0.5 * e * log2(max(1.0 - dot(nxh, nxh), 1e-20))) : 0.0;
  float normalization = (e + 2.0) * (e + 4.0) / (8.0 * kPi * (exp2(-0.5 * e) + e));
  return nl * (response.diffuse * (1.0 / kPi) + response.f0 * (normalization * lobe));
}

#endif
