// Light of the environment on a sphere among others: what they hide of it, and the light that they and the ground
// reflect in its place. In place of ambientOf() of shading/ambient.glsl.
// read    neighbors   see spheres/neighbors/listed.glsl
//         irradiance_above?, spot_cosines_above?   `as linear wrap`: the maps of what is above the horizon, with a ground
#ifndef SPHERES_NEIGHBORS_AMBIENT_GLSL
#define SPHERES_NEIGHBORS_AMBIENT_GLSL

#include "shading/ambient.glsl"
#include "spheres/lobe_varyings.glsl"
#include "spheres/neighbors/irradiance.glsl"
#ifdef HAS_SPECULAR
#include "spheres/neighbors/occluder_light.glsl"
#endif

#ifdef HAS_IRRADIANCE_ABOVE
uniform sampler2D irradiance_above;
#endif
#ifdef HAS_SPOT_COSINES_ABOVE
uniform sampler2D spot_cosines_above;
#endif

// `radius`: of the sphere that has the point.
Ambient ambientAmongSpheres(NeighborList list, Occlusion occlusion, Point point, Surface surface, Response response, Lobe lobe,
                            LightsSeen seen, float radius) {
  Ambient ambient = noAmbient();
  GroundPlane plane = occlusion.plane;
  LobeGround ground = occlusion.ground;
  GroundLight ground_light = groundLight(lobe, sky_above.rgb);
  float surface_below = surfaceOf(plane, point.position);
#ifdef HAS_SPECULAR
  vec3 axis = overGround(lobeAxis(point, response), occlusion.lobe.width, ground.surface);
  // Of a lobe that hardly sees the sky, all of the sky is in its tail.
  vec3 sky = mix(reflectedEnvironment(point, response, lobe, axis), ground_light.sky, ground.surface * smoothstep(0.75, 1.0, ground.share));
  vec3 below = groundRadiance(plane, ground_light, sky, ground.surface, ground.hidden, ground.lights);
  vec3 occluders = occluderRadiance(occlusion, point, surface, radius, lobe, ground_light);
  vec3 behind = mix(sky, below, ground.share);
#if SEES_SCENE
  vec4 scene = max(seenOfScene(point, response), vec4(0.0));
  behind = behind * (1.0 - scene.a) + scene.rgb;
#endif
  ambient.reflected = (behind * occlusion.lobe.seen + occluders) * response.single;
#ifdef HAS_BRIGHTEST
  ambient.reflected += reflectedSpot(point, response, lobe, spotStrength(point, lobe) * seen.spot);
#endif
#endif
#ifdef HAS_IRRADIANCE
  vec3 bent = occlusion.sky.bent;
  vec4 mean = irradianceTowards(irradiance, bent, lobe);
  vec3 open_ground = mix(sky_below.rgb, plane.albedo * totalOf(ground_light), surface_below);
#ifdef HAS_IRRADIANCE_ABOVE
  vec4 above = irradianceTowards(irradiance_above, bent, lobe);
  mean = mix(mean, vec4(above.rgb + open_ground * (0.5 - 0.5 * bent.y), above.a), surface_below);
#endif
  ambient.mean = irradianceSeen(occlusion.sky, point.normal, lobe, mean, seen.spot, open_ground);
#endif
  // The other spots: see ambientOf().
  for (int i = 1; i < spot_count; ++i) {
    vec4 spot = spotIrradiance(i);
    vec3 towards = towardsSpot(i, sky_turn);
    float blur = occlusion.lobe.width * length(ground.at - point.position);
    vec2 past = seenPastSpheres(list, point, ground, blur, towards, spot.w);
    float other = min(otherOf(seen, i), past.x);
    if (towards.y < 0.0) other *= 1.0 - surface_below;
#ifdef HAS_SPECULAR
    ambient.reflected += reflectedOther(point, response, lobe, i, other);
    // The ground's light of it, which groundLight() counts as sky.
    vec3 on_ground = spotFromAbove(i) * (past.y - skyOnGround(plane, ground.hidden)) * plane.albedo;
    ambient.reflected += on_ground * (ground.surface * ground.share * occlusion.lobe.seen) * response.single;
    for (int once = occlusion.lobe.seen < 0.999 ? 1 : 0; once > 0; --once) {
      Occluder there = occluderOf(occlusion.lobe, point, radius, lobe);
      vec3 light = spotOnOccluder(there, radius, surfaceOf(plane, there.place), spot, towards);
      ambient.reflected += light * there.color * ((1.0 - occlusion.lobe.seen) * response.single);
    }
#endif
#if defined HAS_IRRADIANCE && defined HAS_SPOT_COSINES
    float cosine = spotCosine(spot_cosines, i, occlusion.sky.bent, lobe);
#ifdef HAS_SPOT_COSINES_ABOVE
    cosine = mix(cosine, spotCosine(spot_cosines_above, i, occlusion.sky.bent, lobe), surface_below);
#endif
    vec3 direct = vec3(max(dot(point.normal, towards), 0.0) * other);
    ambient.mean = max(ambient.mean + spot.rgb * (direct - cosine * skyArrives(occlusion.sky)), vec3(0.0));
#endif
  }
#ifdef HAS_IRRADIANCE
#ifdef HAS_PROBES
  ambient.mean += bouncedIrradiance(point, lobe);
#endif
#endif
  return ambient;
}

#endif
