// What the spheres around a point of a sphere do to its light: they hide light from everywhere, from the sun and from the brightest spot,
// and what they hide they replace by light that they throw back. For shading/light.glsl.
// Slot neighbours, see neighbours/lists.glsl; not `as linear`.
#ifndef NEIGHBOURS_SURROUND_GLSL
#define NEIGHBOURS_SURROUND_GLSL

#include "neighbours/caps.glsl"
#include "neighbours/lists.glsl"
#include "shading/ibl.glsl"
#ifdef HAS_SUN
#include "scene/sun.glsl"
#endif

uniform sampler2D neighbours;
#ifdef HAS_BRIGHTEST
flat in vec4 spot_around;  // spotAround() of ibl/brightest.glsl
#endif

struct Surround {
  float seen;            // share of a uniform sky's light, weighted by the cosine
  vec3 albedo;           // mean, of what hides the rest
  vec3 bent;             // mean direction of what is seen, unit
  float foot;            // share of the ground that is dark by the sphere itself
  float mirror_seen;     // share of the reflected lobe that nothing hides
  vec3 mirror_albedo;    // of what hides the rest, times its share
  vec3 mirror_facing;    // where that faces, not normalised
  float spot_seen;       // shares of the brightest spot and of the sun
  float sun_seen;
};

// Of a point of the sphere of that row. `axis` of the reflected lobe, not normalised; `roughness` of the surface.
Surround surroundOf(uint row, vec3 at, vec3 n, vec3 axis, float roughness, Lobe lobe) {
  Surround all = Surround(1.0, vec3(0.0), n, 0.0, 1.0, vec3(0.0), vec3(0.0), 1.0, 1.0);
  axis = normalize(axis);
  const float kWidth = 1.6;  // of the cone, in half angles of half vectors
  float alpha = alphaOfRoughness(roughness), cone = kWidth * alpha + 0.005, hidden = 0.0;
  vec3 colors = vec3(0.0), towards = colors;
#ifdef HAS_BRIGHTEST
  float spot_angle = spot_around.w;
#endif
#ifdef HAS_SUN
  vec3 sun_direction = sun_light[0].direction;
  float sun_angle = max(sqrt(max(1.0 - sun_light[0].cos_angle * sun_light[0].cos_angle, 0.0)), 0.002);
#endif
  // By a nearest sampler: in software a fetch that is told its level as a float costs less than one by whole numbers.
  vec2 texel = 1.0 / vec2(textureSize(neighbours, 0)), first = (vec2(neighbourTexel(row, 0)) + 0.5) * texel;
  float reach = textureLod(neighbours, 0.5 * texel, 0.0).x;
  int i = -1;
  while (i < MOST_NEIGHBOURS - 1) {
    // On to the next sphere that takes anything: above the horizon, where lights are, or in the lobe. This loop is short, so that the rest
    // runs for these alone, also where lanes go together.
    // Its count goes up first of all: llvmpipe goes on computing for lanes that have left, from the count that they left with.
    bool counts;
    vec4 ball;
    vec3 to;
    float distance2, distance_to, along;
    do {
      ++i;
      ball = textureLod(neighbours, first + vec2(2 * i, 0) * texel, 0.0);
      to = ball.xyz - at;
      distance2 = dot(to, to);
      distance_to = sqrt(distance2);
      along = dot(axis, to);
      float lobe_ends = ball.w + cone * distance_to;
      counts = distance_to < reach * ball.w &&
               (dot(n, to) > -ball.w || (along > -lobe_ends && distance2 - along * along < lobe_ends * lobe_ends));
    } while (i < MOST_NEIGHBOURS - 1 && !counts && ball.w > 0.0);
    if (!counts) break;
    vec4 light = textureLod(neighbours, first + vec2(2 * i + 1, 0) * texel, 0.0);
    float ratio = max(distance_to / ball.w, 1.0), near = withinReach(ratio, reach);
    float share = capShare(ratio, dot(n, to) / distance_to) * near * abs(light.a);
    if (light.a < 0.0) {
      all.foot = share;
      share = near = 0.0;
    }
    hidden += share;
    colors += share * light.rgb;
    towards += share / distance_to * to;
    float in_lobe = mix(discShare(ball.w, cone * distance_to, along, sqrt(max(distance2 - along * along, 0.0)), distance_to) * near, share, alpha) * all.mirror_seen;
    all.mirror_seen -= in_lobe;
    all.mirror_albedo += in_lobe * light.rgb;
    // Where the axis meets that sphere, or is nearest to it.
    all.mirror_facing += (axis * (along - sqrt(max(ball.w * ball.w - distance2 + along * along, 0.0))) - to) * (in_lobe / ball.w);
#ifdef HAS_BRIGHTEST
    along = dot(lobe.spot, to);
    all.spot_seen *= 1.0 - discShare(ball.w, spot_angle * distance_to, along, sqrt(max(distance2 - along * along, 0.0)), distance_to) * near;
#endif
#ifdef HAS_SUN
    along = dot(sun_direction, to);
    all.sun_seen *= 1.0 - discShare(ball.w, sun_angle * distance_to, along, sqrt(max(distance2 - along * along, 0.0)), distance_to) * near;
#endif
  }
  all.seen = max(1.0 - hidden, 0.0);
  all.albedo = colors / max(hidden, 1e-6);
  // Over the hemisphere the mean direction is 2/3 n.
  towards = n * (2.0 / 3.0) - towards * ((1.0 - all.seen) / max(hidden, 1e-6));
  all.bent = dot(towards, n) > 0.01 ? normalize(towards) : n;
  return all;
}

// Light from everywhere of a point with normal n: `sky` is the irradiance map's value in the bent direction, `below` that straight down. What hides a share of it is lit as this point is, so that the light goes to
// and fro: a geometric series (Stewart and Langer, "Towards accurate recovery of shape from shading under diffuse lighting", PAMI 1997).
vec3 aroundSeen(Surround surround, vec3 n, Lobe lobe, vec3 sky, vec3 below) {
  vec3 seen = vec3(surround.seen);
#ifdef HAS_BRIGHTEST
  vec3 spot = spot_around.rgb;
  sky = max(sky - spot * max(dot(surround.bent, lobe.spot), 0.0), vec3(0.0));
#endif
#ifndef HAS_PROBES
  seen /= 1.0 - surround.albedo * (1.0 - seen);  // with probes these give what comes back
#endif
  vec3 around = sky * seen;
#ifdef HAS_BRIGHTEST
  around += spot * (max(dot(n, lobe.spot), 0.0) * surround.spot_seen);
#endif
  return max(around - below * surround.foot, vec3(0.0));
}

#endif
