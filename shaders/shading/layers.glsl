// What the layers of a material do with light: glTF's KHR_materials_ior, specular, clearcoat, sheen, anisotropy and iridescence.
// With `behind` also transmission and volume, see meshes/behind.glsl.
// A shading model includes it where there is material_layers; main() sets `layers` before it asks for light.
#ifndef SHADING_LAYERS_GLSL
#define SHADING_LAYERS_GLSL

#include "shading/brdf.glsl"
#include "shading/point.glsl"

struct Layers {
  bool on;                 // false: there are none
  vec3 f0;                 // of the dielectric, at normal incidence
  float f90;               // and at grazing incidence
  vec3 sheen;
  float sheen_roughness;
  vec3 coat_normal;        // unit
  float coat, coat_roughness;
  vec3 along;              // unit, where it is rougher; enterLayers() brings it into the surface
  float anisotropy;
  float film, film_ior, film_thickness;  // nm
#ifdef HAS_BEHIND
  float transmission, thickness, ior;    // world units; 0: a thin wall
  vec3 absorption;                       // per unit
  vec3 passed;                           // enterLayers(): share of the light from behind that goes through
#endif
};
Layers layers;

float greatest(vec3 v) { return max(v.x, max(v.y, v.z)); }
float schlick(float f0, float cosine) { return f0 + (1.0 - f0) * pow(1.0 - cosine, 5.0); }

// ---- iridescence: Belcour and Barla, "A practical extension to microfacet theory for the modeling of varying iridescence", SIGGRAPH
// 2017. Two interfaces, of air on the film and of the film on the base, and the phases of what goes between them to and fro.

// Reflectances of both polarizations together, of an interface that is entered at the cosine `c` into a medium `ratio` times as dense.
float fresnelOf(float ratio, float c) {
  float t2 = 1.0 - (1.0 - c * c) / (ratio * ratio);
  if (t2 <= 0.0) return 1.0;
  float t = sqrt(t2), s = (c - ratio * t) / (c + ratio * t), p = (ratio * c - t) / (ratio * c + t);
  return 0.5 * (s * s + p * p);
}

// The color-matching functions, as Gaussians over frequency, transformed: what is seen of a wave of this path (m) and phase.
vec3 seenOfWave(float path, vec3 shift) {
  float phase = 2.0 * kPi * path;
  const vec3 value = vec3(5.4856e-13, 4.4201e-13, 5.2481e-13), place = vec3(1.6810e+06, 1.7953e+06, 2.2084e+06),
             variance = vec3(4.3278e+09, 9.3046e+09, 6.6121e+09);
  vec3 xyz = value * sqrt(2.0 * kPi * variance) * cos(place * phase + shift) * exp(-phase * phase * variance);
  xyz.x += 9.7470e-14 * sqrt(2.0 * kPi * 4.5282e+09) * cos(2.2399e+06 * phase + shift.x) * exp(-4.5282e+09 * phase * phase);
  const mat3 to_srgb = mat3(3.2404542, -0.9692660, 0.0556434, -1.5371385, 1.8760108, -0.2040259, -0.4985314, 0.0415560, 1.0572252);
  return to_srgb * (xyz / 1.0685e-7);
}

vec3 filmReflectance(float nv, float ior, float thickness, vec3 f0) {
  ior = mix(1.0, ior, smoothstep(0.0, 30.0, thickness));  // no film where there is none
  float c2 = 1.0 - (1.0 - nv * nv) / (ior * ior);
  if (c2 <= 0.0) return vec3(1.0);
  float c = sqrt(c2), first = fresnelOf(ior, nv), enters = 1.0 - first;
  vec3 base = (1.0 + sqrt(min(f0, 0.9999))) / (1.0 - sqrt(min(f0, 0.9999)));  // its index of refraction
  vec3 second = vec3(fresnelOf(base.r / ior, c), fresnelOf(base.g / ior, c), fresnelOf(base.b / ior, c));
  vec3 shift = (ior < 1.0 ? 0.0 : kPi) + kPi * (1.0 - step(ior, base));
  vec3 both = clamp(first * second, 1e-5, 0.9999), wave = sqrt(both);
  vec3 round_trip = enters * enters * second / (1.0 - both);
  vec3 seen = first + round_trip, strength = round_trip - enters;
  for (int m = 1; m <= 2; ++m) {
    strength *= wave;
    seen += strength * 2.0 * seenOfWave(float(m) * 2.0 * ior * thickness * 1e-9 * c, float(m) * shift);
  }
  return max(seen, 0.0);
}

// ---- sheen: Estevez and Kulla, "Production friendly microfacet sheen BRDF", SIGGRAPH 2017 courses

float sheenLambda(float x, float alpha) {
  float k = (1.0 - alpha) * (1.0 - alpha);
  float a = mix(21.5473, 25.3245, k), b = mix(3.82987, 3.32435, k), c = mix(0.19823, 0.16801, k), d = mix(-1.97760, -1.27393, k),
        e = mix(-4.32054, -4.85967, k), y = x < 0.5 ? x : 1.0 - x;
  float l = a / (1.0 + b * pow(y, c)) + d * y + e;
  return exp(x < 0.5 ? l : 2.0 * (a / (1.0 + b * pow(0.5, c)) + d * 0.5 + e) - l);
}

// Times N.L, for white.
float sheenOf(vec3 n, vec3 v, vec3 l) {
  float alpha = max(layers.sheen_roughness * layers.sheen_roughness, 1e-3), nl = dot(n, l), nv = max(dot(n, v), 1e-3);
  vec3 across = cross(n, normalize(v + l));
  float distribution = (2.0 + 1.0 / alpha) * pow(max(dot(across, across), 1e-12), 0.5 / alpha) / (2.0 * kPi);
  return distribution / ((1.0 + sheenLambda(nv, alpha) + sheenLambda(nl, alpha)) * 4.0 * nv);
}

// What it reflects of uniform white light: that brdf integrated, by rows of the square root of the cosine, for roughnesses of n / 6.
const float sheen_table[63] = float[](
    1.0, 1.0, 0.8521, 0.1902, 0.0184, 0.0004, 0.0, 0.0, 0.0,
    1.0, 1.0, 0.7797, 0.4066, 0.1700, 0.0511, 0.0089, 0.0005, 0.0,
    0.8770, 0.8408, 0.6456, 0.4514, 0.2905, 0.1663, 0.0791, 0.0272, 0.0024,
    0.8004, 0.7878, 0.6475, 0.4985, 0.3669, 0.2531, 0.1576, 0.0843, 0.0270,
    0.8471, 0.8427, 0.7121, 0.5712, 0.4451, 0.3323, 0.2317, 0.1487, 0.0747,
    0.9224, 0.9193, 0.7841, 0.6398, 0.5117, 0.3965, 0.2922, 0.2049, 0.1256,
    0.9314, 0.9288, 0.7967, 0.6571, 0.5343, 0.4239, 0.3236, 0.2398, 0.1638);
float sheenReflectance(float cosine) {
  vec2 at = clamp(vec2(8.0 * sqrt(max(cosine, 0.0)), 6.0 * layers.sheen_roughness), vec2(0.0), vec2(8.0, 6.0));
  ivec2 low = min(ivec2(at), ivec2(7, 5));
  vec2 share = at - vec2(low);
  int i = low.y * 9 + low.x;
  return mix(mix(sheen_table[i], sheen_table[i + 1], share.x), mix(sheen_table[i + 9], sheen_table[i + 10], share.x), share.y);
}

// What it leaves of the light of what is below.
float pastSheen(float nv) {
  if (greatest(layers.sheen) <= 0.0) return 1.0;
  return 1.0 - greatest(layers.sheen) * max(sheenReflectance(nv), sheenReflectance(0.6));  // 0.6: for light that arrives from everywhere
}

// ---- all of them

// Along the grooves and across. KHR_materials_anisotropy.
vec2 alphasOf(float roughness) {
  float alpha = alphaOfRoughness(roughness);
  return max(vec2(mix(alpha, 1.0, layers.anisotropy * layers.anisotropy), alpha), 0.002);
}

// `surface` below its coat. Its energy: shading/material.glsl.
Response layeredResponse(Surface surface, float nv) {
  vec2 alphas = alphasOf(surface.roughness);
  if (layers.anisotropy > 0.0) surface.roughness = sqrt(sqrt(0.5 * dot(alphas, alphas)));
  vec4 split = textureLod(brdf, vec2(nv, surface.roughness), 0.0);
  Response response = responseOf(surface, nv);
  vec3 f0[2] = vec3[](layers.f0, surface.albedo), f90[2] = vec3[](vec3(layers.f90), vec3(1.0)), single[2], several[2];
  float lost = 1.0 - split.x - split.y;
  for (int i = 0; i < 2; ++i) {
    if (layers.film > 0.0) {
      vec3 film = filmReflectance(nv, layers.film_ior, layers.film_thickness, f0[i]);
      f0[i] = mix(f0[i], film, layers.film);
      f90[i] = mix(f90[i], film, layers.film);
    }
    single[i] = f0[i] * split.x + f90[i] * split.y;
    vec3 average = f0[i] + (f90[i] - f0[i]) / 21.0;
    several[i] = single[i] * average * lost / (1.0 - lost * average) * float(COMPENSATION);
  }
  response.f0 = mix(f0[0], f0[1], surface.metallic);
  response.f90 = mix(f90[0], f90[1], surface.metallic);
  response.single = mix(single[0], single[1], surface.metallic);
  response.multiple = mix(several[0], several[1], surface.metallic);
  response.diffuse = surface.albedo * ((1.0 - surface.metallic) * (1.0 - greatest(single[0] + several[0])));
#ifdef HAS_BEHIND
  layers.passed = response.diffuse * layers.transmission;
  response.diffuse -= layers.passed;
  layers.passed *= pastSheen(nv);
#endif
  return response;
}

// The coat by itself: KHR_materials_clearcoat takes the Fresnel term of the view.
float coatReflectance(vec3 v) { return layers.coat * schlick(0.04, clamp(dot(layers.coat_normal, v), 0.0, 1.0)); }
Response coatResponse(vec3 v) {
  float nv = clamp(dot(layers.coat_normal, v), 0.0, 1.0), fresnel = coatReflectance(v);
  Response response = responseOf(Surface(vec3(1.0), 1.0, layers.coat_roughness), nv);
  response.f0 = response.f90 = vec3(fresnel);
  response.single *= fresnel;
  response.multiple = vec3(0.0);
  return response;
}

// The mirror direction of brushed metal: that of a normal turned to the view, across the grooves (after "Physically based rendering in
// Filament", 5.3.4).
vec3 brushedMirror(vec3 n, vec3 v, float roughness) {
  vec3 across = cross(n, layers.along), turned = normalize(v - across * dot(across, v));
  float share = layers.anisotropy * layers.anisotropy * (1.0 - alphaOfRoughness(roughness));
  return reflect(-v, normalize(mix(n, turned, share)));
}

// As cookTorrance(), with a roughness along `layers.along` and one across (Heitz, JCGT 2014).
vec3 brushed(Response response, vec3 n, vec3 v, vec3 l, vec2 alphas) {
  vec3 across = cross(n, layers.along), h = normalize(v + l);
  mat3 frame = transpose(mat3(layers.along, across, n));
  vec3 tv = frame * v, tl = frame * l, th = frame * h;
  tv.z = max(tv.z, 1e-4);
  vec3 stretched = vec3(th.xy / alphas, th.z);
  float f = dot(stretched, stretched), distribution = 1.0 / (kPi * alphas.x * alphas.y * f * f);
  float masking = 0.5 / (tl.z * length(vec3(alphas * tv.xy, tv.z)) + tv.z * length(vec3(alphas * tl.xy, tl.z)));
  float m = 1.0 - clamp(dot(v, h), 0.0, 1.0);
  vec3 fresnel = response.f0 + (response.f90 - response.f0) * (m * m * m * m * m);
  return tl.z * (distribution * masking * fresnel + (response.multiple + response.diffuse) * (1.0 / kPi));
}

float groove_roughness;  // of the surface, across its grooves

// What the light of the first layer meets.
Response enterLayers(inout Point point, Surface surface) {
  groove_roughness = surface.roughness;
  layers.along = normalize(layers.along - point.normal * dot(point.normal, layers.along) + vec3(1e-6));
  if (layers.anisotropy > 0.0) point.mirror = brushedMirror(point.normal, point.to_eye, surface.roughness);
  return layeredResponse(surface, point.nv);
}

// From here on the coat is what is lit. The share of what is below that it lets through.
float coverWithCoat(inout Point point, out Response response) {
  float fresnel = coatReflectance(point.to_eye);
  response = coatResponse(point.to_eye);
  point.normal = layers.coat_normal;
  point.mirror = reflect(-point.to_eye, point.normal);
  point.nv = clamp(dot(point.normal, point.to_eye), 0.0, 1.0);
  layers.on = false;
  return 1.0 - fresnel;
}

vec3 layeredAmbient(Point point, Response response, Ambient ambient) {
#if SEES_SCENE
  vec3 light = ambientWithScene(ambient, response.multiple, response.diffuse, point.sky_visible, point.sky_visible);
#else
  vec3 light = (ambient.reflected + (response.multiple + response.diffuse) * ambient.mean) * point.sky_visible;
#endif
  if (greatest(layers.sheen) <= 0.0) return light;
  return light * pastSheen(point.nv) + layers.sheen * sheenReflectance(point.nv) * ambient.mean * point.sky_visible;
}

vec3 layeredDirect(Point point, Response response, vec3 l) {
  vec3 n = point.normal, v = point.to_eye;
  if (dot(n, l) <= 0.0) return vec3(0.0);
  vec3 light = layers.anisotropy > 0.0 ? brushed(response, n, v, l, alphasOf(groove_roughness)) : cookTorrance(response, n, v, l);
  float sheen = greatest(layers.sheen);
  if (sheen > 0.0)
    light = light * (1.0 - sheen * max(sheenReflectance(point.nv), sheenReflectance(dot(n, l)))) + layers.sheen * sheenOf(n, v, l);
  return light;
}

#endif
