// Light of the environment: what a lobe reflects of its maps, its brightest spots in closed form, and irradiance.
// read    irradiance?, specular?, environment?, brightest?   see shading/environment.glsl; without one its light is missing
//         spot_cosines?   see there
//         probes?, sh?   light that other things reflect, see gi/bounce.glsl
//         air?   fog in front of what is reflected, see fog/sky.glsl
//         mirrored?, or mirror_light?, probe_light? and theirs   the scene in reflections, see reflections/seen.glsl
#ifndef SHADING_AMBIENT_GLSL
#define SHADING_AMBIENT_GLSL

#include "fog/sky.glsl"
#include "shading/environment.glsl"
#include "shading/material.glsl"
#include "shading/point.glsl"
#ifdef HAS_PROBES
#include "gi/bounce.glsl"
#endif
#if SEES_SCENE
#include "reflections/seen.glsl"
#endif

// Axis of the reflected lobe, not normalized.
vec3 lobeAxis(Point point, Response response) { return mix(point.mirror, point.normal, response.lean); }

#ifdef HAS_SPECULAR
// Mean radiance of the environment in the lobe around `axis`.
vec3 reflectedEnvironment(Point point, Response response, Lobe lobe, vec3 axis) {
  float level = min(lobe.specular_level + response.level_shift * lobe.level_per_shift, lobe.last_level);
  vec2 uv = equirectUv(axis) - vec2(sky_turn, 0.0);
  vec3 radiance = sampleEquirect(specular, uv, equirectLookup(level, lobe.specular_pole)).rgb;
#ifdef HAS_ENVIRONMENT
  vec3 sharp = sampleEquirect(environment, uv, vec2(lobe.environment_level, lobe.environment_pole)).rgb;
  // The spot is not to be seen twice.
  float cut = dot(point.mirror, lobe.spot) > kNearCosine ? lobe.spot_cut : 0.0;
  sharp -= cut * max(sharp - lobe.spot_limit, 0.0);
  radiance = mix(sharp, radiance, lobe.specular_weight);
#endif
#ifdef HAS_AIR
  radiance = mix(fog_light.rgb, radiance, throughFogOfSky(axis, point.position.y, alphaOfRoughness(response.roughness)));
#endif
  return radiance;
}

// Squared width of the lobe with that of its pixel.
float alpha2OfLobe(Lobe lobe) { return exp2((lobe.specular_level / max(lobe.last_level, 1.0) - 1.0) * 4.0 * kOctaves); }

// |V + L|^2 for light from the spot.
float spotHalf2(Point point, Lobe lobe) {
  float nl = max(dot(point.normal, lobe.spot), 0.0);
  return max(2.0 + 4.0 * point.nv * nl - 2.0 * dot(point.mirror, lobe.spot), 1e-6);
}

// Distribution over masking, for light from the spot: GGX with Smith's height-correlated masking (Heitz, JCGT 2014).
float spotStrength(Point point, Lobe lobe) {
  float nv = point.nv, nl = max(dot(point.normal, lobe.spot), 0.0), a2 = lobe.spot_shape.alpha2, h2 = spotHalf2(point, lobe);
  float masking = nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2);
  return spotDistribution(lobe.spot_shape, max(h2 - (nv + nl) * (nv + nl), 0.0), h2, nl, max(masking, 1e-6));
}

// Radiance towards the eye of the spot's reflection, with Schlick's Fresnel.
vec3 reflectedSpot(Point point, Response response, Lobe lobe, float strength) {
  float m = 1.0 - 0.5 * sqrt(spotHalf2(point, lobe)), m2 = m * m;
  vec3 fresnel = response.f0 + (response.f90 - response.f0) * (m2 * m2 * m);
#ifdef HAS_AIR
  strength *= throughFogOfSky(lobe.spot, point.position.y, 0.0);
#endif
  return fresnel * lobe.spot_light * strength;
}

// Of a spot after the first. Lookups of `environment` keep these; beside `specular`, which lacks them, they are made a pixel wide or more.
vec3 reflectedOther(Point point, Response response, Lobe lobe, int i, float seen) {
  float alpha2 = lobe.spot_shape.alpha2, pixel = 1.5 * max(alpha2OfLobe(lobe) - alpha2, 0.0);
  lobe.spot = towardsSpot(i, sky_turn);
  lobe.spot_light = spots[i].light.rgb * (lobe.specular_weight / (2.0 * kPi));
  lobe.spot_shape = spotShape(sqrt(alpha2), min(0.25 * spots[i].light.w + pixel, 0.25));
  return reflectedSpot(point, response, lobe, spotStrength(point, lobe) * seen);
}
#endif

#ifdef HAS_IRRADIANCE
// Of a map of irradiance over pi, for a surface that faces a direction.
vec4 irradianceTowards(sampler2D map, vec3 facing, Lobe lobe) {
  return sampleEquirect(map, equirectUv(facing) - vec2(sky_turn, 0.0), vec2(0.0, lobe.irradiance_pole));
}

float spotCosine(sampler2D map, int i, vec3 facing, Lobe lobe) { return dot(irradianceTowards(map, facing, lobe), onlySpot(i)); }

#ifdef HAS_PROBES
// The part of it that other things reflect.
vec3 bouncedIrradiance(Point point, Lobe lobe) {
  vec3 coefficients[9];
  float left = probeAt(point.position, coefficients);
  Bounce bounce = bounceOf(coefficients, left, point.normal);
  vec2 lookup = vec2(0.0, lobe.irradiance_pole);
  vec2 front = equirectUv(bounce.facing) - vec2(sky_turn, 0.0), back = vec2(front.x + 0.5, 1.0 - front.y);
  return bounced(bounce, sampleEquirect(irradiance, front, lookup).rgb, sampleEquirect(irradiance, back, lookup).rgb);
}
#endif
#endif

Ambient ambientOf(Point point, Response response, Lobe lobe, LightsSeen seen) {
  Ambient ambient = noAmbient();
  float aside = 1.0;  // what a lobe sees of the spots past the scene
#ifdef HAS_SPECULAR
#if SEES_SCENE
  vec4 scene = seenOfScene(point, response);
  scene.rgb = max(scene.rgb, vec3(0.0));
#endif
  ambient.reflected = reflectedEnvironment(point, response, lobe, lobeAxis(point, response)) * response.single;
#if SEES_SCENE
  ambient.traced = scene.rgb * response.single;
  ambient.open = 1.0 - scene.a;
  // What a smooth lobe meets hides the spots; a rough one sees them from aside.
  aside = mix(1.0, 1.0 / max(ambient.open, 1e-3), smoothstep(0.1, 0.4, response.roughness));
#endif
#ifdef HAS_BRIGHTEST
  ambient.reflected += reflectedSpot(point, response, lobe, spotStrength(point, lobe) * (seen.spot * aside));
#endif
#endif
#ifdef HAS_IRRADIANCE
  vec4 mean = irradianceTowards(irradiance, point.normal, lobe);
  ambient.mean = mean.rgb - spotIrradiance(0).rgb * (mean.a * (1.0 - seen.spot));
#endif
  // One loop for all that the other spots do: in software one costs also where it is not entered.
  for (int i = 1; i < spot_count; ++i) {
    float other = otherOf(seen, i);
#ifdef HAS_SPECULAR
    ambient.reflected += reflectedOther(point, response, lobe, i, other * aside);
#endif
#if defined HAS_IRRADIANCE && defined HAS_SPOT_COSINES
    ambient.mean -= spotIrradiance(i).rgb * (spotCosine(spot_cosines, i, point.normal, lobe) * (1.0 - other));
#endif
  }
#ifdef HAS_IRRADIANCE
  ambient.mean = max(ambient.mean, vec3(0.0));
#ifdef HAS_PROBES
  ambient.mean += bouncedIrradiance(point, lobe);
#endif
#if SEES_SCENE
  ambient.traced += response.multiple * scene.rgb;
#endif
#endif
  return ambient;
}

#endif
