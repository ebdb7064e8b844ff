// Light that the spheres in a reflected lobe send to the point.
#ifndef SPHERES_NEIGHBORS_OCCLUDER_LIGHT_GLSL
#define SPHERES_NEIGHBORS_OCCLUDER_LIGHT_GLSL

#include "spheres/neighbors/ground_light.glsl"

const float kLeastShare = 0.002;  // of a lobe that is worth to be looked at

// The means over what hides the lobe stand for all of it: one place on one sphere.
struct Occluder {
  vec3 color, place;
  vec3 facing, normals;  // unit; the mean of the normals that the lobe meets
  float metallic, slant;
  vec3 axis;             // of its own lobe
  float alpha, blur;     // of that; how wide the lobe is there
  vec3 to;               // to the center of the sphere that has the point
};

Occluder occluderOf(LobeOcclusion reflected, Point point, float own_radius, Lobe lobe) {
  float per_hidden = 1.0 / max(1.0 - reflected.seen, 1e-3), away = reflected.material.distance * per_hidden;
  vec3 color = reflected.material.albedo * per_hidden, facing = normalize(reflected.normal);
  float metallic = reflected.material.metallic * per_hidden, occluder_alpha2 = reflected.material.alpha2 * per_hidden;
  vec3 place = point.position + reflected.axis * away;
  float slant = clamp(-dot(reflected.axis, facing), 0.0, 1.0), m = 1.0 - slant, m2 = m * m;
  color += max(vec3(1.0 - sqrt(sqrt(occluder_alpha2))) - color, vec3(0.0)) * (m2 * m2 * m * metallic);
  // Its lobe: that of this point, with the width of its pixel, is widened by the other sphere's curvature, then by
  // that sphere's roughness.
  vec3 axis = normalize(mix(facing, reflected.axis + 2.0 * slant * facing, metallic));
  float spread = 1.0 + 2.0 * reflected.material.distance_in_radii * per_hidden;
  float alpha2 = mix(1.0, alpha2OfLobe(lobe) * spread * spread + occluder_alpha2, metallic);
  return Occluder(color, place, facing, reflected.normal * per_hidden, metallic, slant, axis, sqrt(clamp(alpha2, 1e-6, 1.0)),
                  reflected.width * away, point.position - point.normal * own_radius - place);
}

// What it reflects of a spot. `surface`: of the ground below it, see surfaceOf().
vec3 spotOnOccluder(Occluder self, float own_radius, float surface, vec4 spot, vec3 towards) {
  float half2 = 0.5 + 0.5 * dot(self.axis, towards), a2 = min(self.alpha * self.alpha + spot.w * spot.w, 1.0);
  float d = half2 * (a2 - 1.0) + 1.0;
  // Mean of the cosine over the normals that the lobe meets: the shorter their mean, the farther apart they are. So
  // there is no edge where it gets dark. A metal's light ends there by Smith's height-correlated masking.
  float cosine = dot(self.normals, towards), slant = self.slant;
  float nl = 0.5 * (cosine + sqrt(cosine * cosine + 0.25 * max(1.0 - dot(self.normals, self.normals), 0.0)));
  float masking = nl * sqrt(slant * slant * (1.0 - a2) + a2) + slant * sqrt(nl * nl * (1.0 - a2) + a2);
  float metal = 0.5 * a2 * nl / (d * d * max(masking, 1e-4));
  // The sphere that has the point may hide the light.
  float past = 1.0 - ballShare(own_radius, spot.w, self.blur, towards, self.to, dot(self.to, self.to));
  if (towards.y < 0.0) past *= 1.0 - surface;  // the ground hides it
  return spot.rgb * (mix(nl, metal, self.metallic) * past);
}

// Where what hides the lobe is metal, it reflects the sky, the ground, and this sphere, whose light is about `back` there; the rest of it
// is taken for a lobe of roughness 1. `own_radius`: of the sphere that has the point. A loop of one turn stands where a condition would
// do: in software a condition skips nothing.
vec3 occluderRadiance(Occlusion occlusion, Point point, Surface own, float own_radius, Lobe lobe, GroundLight ground) {
  vec3 sum = vec3(0.0);
  GroundPlane plane = occlusion.plane;
  LobeOcclusion reflected = occlusion.lobe;
  for (int once = reflected.seen < 0.999 ? 1 : 0; once > 0; --once) {
    Occluder there = occluderOf(reflected, point, own_radius, lobe);
    vec3 place = there.place, facing = there.facing, axis = there.axis, to = there.to;
    float alpha = there.alpha, cone = coneOfAlpha(alpha);
    float below = plane.exists * shareBelow(axis.y, cone), surface = surfaceOf(plane, place);

    // This sphere, in that lobe, and its lobe there.
    float distance2 = dot(to, to), distance_to = sqrt(distance2), along = dot(axis, to);
    float beside = sqrt(max(distance2 - along * along, 0.0)), own_radius2 = own_radius * own_radius;
    float sharp_share = discShare(own_radius, cone * distance_to, along, beside, distance_to);
    float share = mix(sharp_share, own_radius2 * max(dot(facing, to), 0.0) / (distance2 * distance_to), alpha);
    float deep = sqrt(max(own_radius2 - distance2 + along * along, 0.0)), far = max(along - deep, 0.0);
    vec3 own_facing = normalize(axis * far - to);
    vec3 again = mix(own_facing, reflect(axis, own_facing), own.metallic);
    float own_alpha = min(alpha * (1.0 + 2.0 * far / own_radius) + alphaOfRoughness(own.roughness), 1.0);
    float again_alpha = mix(1.0, own_alpha, own.metallic), again_cone = coneOfAlpha(again_alpha);
    float again_below = plane.exists * surface * shareBelow(again.y, again_cone);

    // The environment: what this sphere sees there, if it counts, then what that one sees. A call is its code again, a
    // turn is not.
    vec3 light = vec3(0.0), back = light;
    for (int turn = share > kLeastShare ? 2 : 1; turn > 0; --turn) {
      vec3 lifted = overGround(turn > 1 ? again : axis, turn > 1 ? again_cone : cone, surface);
      float level = clamp(placeOfAlpha(turn > 1 ? again_alpha : alpha), 0.0, 1.0) * lobe.last_level;
      back = light;
      vec2 uv = equirectUv(lifted) - vec2(sky_turn, 0.0);
      light = sampleEquirect(specular, uv, equirectLookup(level, lobe.specular_pole)).rgb;
    }

    // The ground that it sees, with what it and this sphere hide of that.
    vec3 on_ground = coneOnGround(plane, place, axis, cone);
    float radius = reflected.material.distance / max(reflected.material.distance_in_radii, 1e-4 * (1.0 - reflected.seen));
    vec4 taken = vec4(there.color, 1.0) * capOnGround(place - facing * radius - on_ground, radius) +
                 vec4(own.albedo, 1.0) * capOnGround(place + to - on_ground, own_radius);
    float lit = max(1.0 - taken.a, 0.0);
    light = mix(light, groundRadiance(plane, ground, light, surface, taken, LightsSeen(lit, lit, vec3(lit))), below);
    light = mix(light, mix(back, plane.albedo * totalOf(ground), again_below) * own.albedo, share);

#ifdef HAS_BRIGHTEST
    light += spotOnOccluder(there, own_radius, surface, spotIrradiance(0), lobe.spot);
#endif
    sum = light * there.color * (1.0 - reflected.seen);
  }
  return sum;
}

#endif
