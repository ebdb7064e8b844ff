// What the other spheres around a point of a sphere hide: of the sky, of a reflected lobe, of the sun and of the
// first of the brightest spots.
// read    neighbors   see spheres/neighbors/listed.glsl
//         sun?, brightest?   see scene/sun.glsl, ibl/brightest.glsl
#ifndef SPHERES_NEIGHBORS_OCCLUSION_GLSL
#define SPHERES_NEIGHBORS_OCCLUSION_GLSL

#include "shading/environment.glsl"
#include "shading/material.glsl"
#include "shading/point.glsl"
#include "spheres/neighbors/caps.glsl"
#include "spheres/neighbors/listed.glsl"
#ifdef HAS_SUN
#include "scene/sun.glsl"
#endif

// Of a uniform sky, weighted by the cosine.
struct SkyOcclusion {
  float seen;     // share that nothing hides
  vec3 albedo;    // mean albedo of what hides the rest
  vec3 bent;      // mean direction of what is seen, unit
  float contact;  // share of the ground that the sphere itself darkens, around its contact point
};

// Sums over what hides a lobe, times the share that each hides.
struct OccluderMaterial {
  vec3 albedo;
  float alpha2;             // squared width of its GGX lobe
  float metallic;
  float distance;           // from the point
  float distance_in_radii;
};

// Of the reflected lobe.
struct LobeOcclusion {
  vec3 axis;    // unit
  float width;  // tangent of half the angle of the lobe's cone
  float seen;   // share that nothing hides
  vec3 normal;  // mean normal of what hides the rest, times its share
  OccluderMaterial material;
};

// The ground below, where the lower part of the lobe meets it.
struct LobeGround {
  float share;        // share of the lobe below the horizon
  vec3 at;            // world
  float surface;      // see surfaceOf()
  vec4 hidden;        // a: share of the sky that spheres hide from there; rgb: that times their albedo
  LightsSeen lights;  // from there
};

struct Occlusion {
  GroundPlane plane;
  SkyOcclusion sky;
  LobeOcclusion lobe;
  LobeGround ground;
  LightsSeen lights;
};

const float kConeWidth = 1.6;  // width of a lobe's cone, in alphas

float coneOfAlpha(float alpha) { return kConeWidth * alpha + 0.005; }

// The share of a cone that lies below the horizon. `height` is y of its unit axis, `wide` the tangent of half its
// angle.
float shareBelow(float height, float wide) {
  float x = clamp(0.5 - 0.5 * height / wide, 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

// Where the lower part of a cone meets the ground.
vec3 coneOnGround(GroundPlane plane, vec3 from, vec3 axis, float wide) {
  vec3 at = from + axis * ((from.y - plane.height) / max(-axis.y, max(0.5 * wide, 0.01)));
  return vec3(at.x, plane.height, at.z);
}

// How much surface the ground has at a place: 1 within half its radius, 0 from its radius on.
float surfaceOf(GroundPlane plane, vec3 at) {
  return plane.radius > 0.0 ? 1.0 - smoothstep(0.5 * plane.radius, plane.radius, length(at.xz)) : 0.0;
}

// The share of a uniform sky that a sphere hides from the ground; `to` goes to its center.
float capOnGround(vec3 to, float radius) {
  float per = inversesqrt(max(max(dot(to, to), radius * radius), 1e-20));
  return abs(to.y) * radius * radius * per * per * per;
}

// The share of a light's disc that a sphere covers; `to` goes to the sphere's center. The disc has the half angle
// `angle`, and is `blur` wider, a length.
float ballShare(float radius, float angle, float blur, vec3 light, vec3 to, float distance2) {
  float along = dot(light, to), away = sqrt(distance2);
  return discShare(radius, angle * away + blur, along, sqrt(max(distance2 - along * along, 0.0)), away);
}

// The discs of the lights far away: unit directions and half angles.
struct LightDiscs {
  vec3 sun, spot;
  float sun_angle, spot_angle;
};
LightDiscs lightDiscs(Lobe lobe) {
  LightDiscs discs = LightDiscs(vec3(0.0), lobe.spot, 0.0, spotIrradiance(0).w);
#ifdef HAS_SUN
  float cosine = sun_light[0].cos_angle;
  discs.sun = sun_light[0].direction;
  discs.sun_angle = max(sqrt(max(1.0 - cosine * cosine, 0.0)), 0.002);
#endif
  return discs;
}

// Removes what a sphere hides of the lights, times `weight`.
void hideLights(inout LightsSeen seen, LightDiscs discs, float radius, float blur, vec3 to, float distance2,
                float weight) {
#ifdef HAS_BRIGHTEST
  seen.spot *= 1.0 - ballShare(radius, discs.spot_angle, blur, discs.spot, to, distance2) * weight;
#endif
#ifdef HAS_SUN
  seen.sun *= 1.0 - ballShare(radius, discs.sun_angle, blur, discs.sun, to, distance2) * weight;
#endif
}

// Removes what a sphere hides of the lobe. `share`: of the sky; `near`: its weight; `to` goes to its center.
void hideLobe(inout LobeOcclusion all, float alpha, float radius, vec3 albedo, vec3 material, vec3 to, float distance2,
              float share, float near) {
  float away = sqrt(distance2), along = dot(all.axis, to), beside = sqrt(max(distance2 - along * along, 0.0));
  float wide = all.width * away;
  float hidden = mix(discShare(radius, wide, along, beside, away) * near, share, alpha) * all.seen;
  // Where the middle of what the lobe and the sphere share meets it.
  float middle = 0.5 * (max(beside - wide, -radius) + min(beside + wide, radius));
  float deep = sqrt(max(radius * radius - middle * middle, 0.0));
  vec3 facing = (all.axis * along - to) * (middle / max(beside, 1e-6)) - all.axis * deep;
  float far = max(along - deep, 0.0), alpha_of_it = alphaOfRoughness(material.y);
  // Over a part of the sphere the mean normal is shorter than 1; over the half that is seen it is 2/3.
  float part = min(wide / radius, 1.0);
  all.seen -= hidden;
  all.normal += facing * (hidden / radius * (1.0 - part * part * (1.0 / 3.0)));
  all.material.albedo += hidden * albedo;
  all.material.alpha2 += hidden * alpha_of_it * alpha_of_it;
  all.material.metallic += hidden * material.z;
  all.material.distance += hidden * far;
  all.material.distance_in_radii += hidden * far / radius;
}

// Weight of what a sphere hides from the ground below a point: as far as it is above the point's horizon, and all of it
// where it is the point's own sphere.
float weightOnGround(bool is_image, float height, float near) {
  return is_image ? 1.0 : clamp(height + 1.0, 0.0, 1.0) * near;
}

// The visible share of the disc of a light past all spheres: from a point, x, and from where its lobe meets the ground, y. What occlusionOf()
// has of the sun and of the first spot.
vec2 seenPastSpheres(NeighborList list, Point point, LobeGround ground, float ground_blur, vec3 light, float angle) {
  vec2 seen = vec2(1.0);
  for (int i = 0; i < MOST_NEIGHBORS; ++i) {
    Neighbor ball = neighborOf(list, i);
    if (ball.radius == 0.0) break;
    vec3 to = ball.center - point.position, over = ball.center - ground.at;
    over.y = abs(over.y);
    float away2 = dot(to, to), near = withinReach(max(sqrt(away2) / ball.radius, 1.0), list.reach);
    bool is_image = neighborMaterial(list, i).a < 0.0;
    vec2 weights = vec2(is_image ? 0.0 : near, weightOnGround(is_image, dot(point.normal, to) / ball.radius, near));
    seen.x *= 1.0 - ballShare(ball.radius, angle, 0.0, light, to, away2) * weights.x;
    seen.y *= 1.0 - ballShare(ball.radius, angle, ground_blur, light, over, dot(over, over)) * weights.y;
  }
  return seen;
}

// Of a point of a sphere with this surface; `axis` is that of the reflected lobe, of any length. In software a
// condition skips nothing, but a loop that no lane enters does; so the loop looks for the next sphere that hides
// anything.
Occlusion occlusionOf(NeighborList list, Point point, Surface surface, vec3 axis, Lobe lobe) {
  axis = normalize(axis);
  vec3 n = point.normal, colors = vec3(0.0), towards = colors;
  float alpha = alphaOfRoughness(surface.roughness), cone = coneOfAlpha(alpha), hidden = 0.0;
  GroundPlane plane = list.ground;
  vec3 on_ground = coneOnGround(plane, point.position, axis, cone);
  float ground_blur = cone * length(on_ground - point.position);
  float below = plane.exists * mix(shareBelow(axis.y, cone), 0.5 - 0.5 * n.y, alpha);
  SkyOcclusion sky = SkyOcclusion(1.0, vec3(0.0), n, 0.0);
  LobeOcclusion reflected = LobeOcclusion(axis, cone, 1.0, vec3(0.0), OccluderMaterial(vec3(0.0), 0.0, 0.0, 0.0, 0.0));
  LobeGround ground = LobeGround(below, on_ground, surfaceOf(plane, on_ground), vec4(0.0), kOpen);
  LightsSeen lights = kOpen;
  LightDiscs discs = lightDiscs(lobe);

  int i = -1;
  while (i < MOST_NEIGHBORS - 1) {
    // Goes on to the next sphere that hides anything: it is above the horizon, where lights are, or in the lobe. This
    // loop is short. The code after it runs for such spheres alone, also where lanes go together. Its count goes up
    // first of all: llvmpipe goes on computing for lanes that have left, from the count that they left with.
    bool counts;
    Neighbor ball;
    vec3 to;
    float distance2, away;
    do {
      ++i;
      ball = neighborOf(list, i);
      to = ball.center - point.position;
      distance2 = dot(to, to);
      away = sqrt(distance2);
      float along = dot(axis, to), lobe_ends = ball.radius + cone * away;
      bool in_lobe = along > -lobe_ends && distance2 - along * along < lobe_ends * lobe_ends;
      counts = away < list.reach * ball.radius && (dot(n, to) > -ball.radius || in_lobe);
    } while (i < MOST_NEIGHBORS - 1 && !counts && ball.radius > 0.0);
    if (!counts) break;

    vec4 packed_material = neighborMaterial(list, i);
    vec3 albedo = packed_material.rgb, material = unpackMaterial(packed_material.a);
    bool is_image = packed_material.a < 0.0;  // of the sphere itself in the ground
    float ratio = max(away / ball.radius, 1.0), near = withinReach(ratio, list.reach);
    float share = capShare(ratio, dot(n, to) / away) * near;
    vec3 over = ball.center - on_ground;
    over.y = abs(over.y);
    float over2 = dot(over, over), weight = weightOnGround(is_image, dot(n, to) / ball.radius, near);
    ground.hidden += vec4(is_image ? surface.albedo : albedo, 1.0) * (capOnGround(over, ball.radius) * weight);
    hideLights(ground.lights, discs, ball.radius, ground_blur, over, over2, weight);
    if (is_image) {
      sky.contact = share * -packed_material.a;
      share = near = 0.0;
    }
    share *= material.x;
    hidden += share;
    colors += share * albedo;
    towards += share / away * to;
    hideLobe(reflected, alpha, ball.radius, albedo, material, to, distance2, share, near);
    hideLights(lights, discs, ball.radius, 0.0, to, distance2, near);
  }

  sky.seen = max(1.0 - hidden, 0.0);
  sky.albedo = colors / max(hidden, 1e-6);
  // Over the hemisphere the mean direction is 2/3 n.
  towards = n * (2.0 / 3.0) - towards * ((1.0 - sky.seen) / max(hidden, 1e-6));
  sky.bent = dot(towards, n) > 0.01 ? normalize(towards) : n;
  return Occlusion(plane, sky, reflected, ground, lights);
}

#endif
