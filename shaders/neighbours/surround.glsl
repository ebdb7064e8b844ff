// What the spheres around a point of a sphere do to its light: they hide light from everywhere, from the sun and from the brightest spot,
// and what they hide they replace by light that they throw back. For shading/light.glsl.
// Slot neighbours, see neighbours/listed.glsl. A loop of one turn stands where a condition would do: in software a condition skips nothing, a
// loop that no lane enters does. Small ones cost more than they skip.
#ifndef NEIGHBOURS_SURROUND_GLSL
#define NEIGHBOURS_SURROUND_GLSL

#include "neighbours/caps.glsl"
#include "neighbours/listed.glsl"
#include "shading/ibl.glsl"
#ifdef HAS_SUN
#include "scene/sun.glsl"
#endif

#ifdef HAS_BRIGHTEST
vec4 spot_around = spotAround();
#endif

// The ground, as the lists say it.
struct Soil {
  float is;  // 1: there is a ground
  float height, radius;
  vec3 albedo;
};

struct Surround {
  float seen;            // share of a uniform sky's light, weighted by the cosine
  vec3 albedo;           // mean albedo of what hides the rest
  vec3 bent;             // mean direction of what is seen, unit
  float foot;            // share of the ground that the sphere itself darkens, around its foot
  float mirror_seen;     // share of the reflected lobe that nothing hides
  vec3 mirror;           // the lobe's axis, unit
  float mirror_width;    // tangent of half the angle of the lobe's cone
  vec3 mirror_albedo;    // albedo of what hides the rest, times its share
  vec3 mirror_facing;    // mean normal of what hides the rest, times its share
  vec4 mirror_matter;    // four numbers of what hides the rest, times its share: alpha squared, metallic, distance over radius, distance
  Soil soil;
  float ground_share;    // share of the lobe below the ground's horizon
  vec3 ground_at;        // where the lobe meets the ground
  float ground_surface;  // how much surface it has there
  vec4 ground_hidden;    // seen from there: w is the share of the sky that spheres hide, rgb is that times their albedo
  vec2 ground_lit;       // seen from there: the visible shares of the brightest spot and of the sun
  float spot_seen;       // visible shares of the brightest spot and of the sun
  float sun_seen;
};

const float kConeWidth = 1.6;  // width of a lobe's cone, in alphas
const float kLeast = 0.002;    // share of a lobe that is worth to be looked at

// The share of a cone that lies below the horizon. `height` is y of its unit axis, `wide` the tangent of half its angle.
float shareBelow(float height, float wide) {
  float x = clamp(0.5 - 0.5 * height / wide, 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

// How much surface the ground has at a place: 1 within half its radius, 0 from its radius on.
float surfaceOf(Soil soil, vec3 at) { return soil.radius > 0.0 ? 1.0 - smoothstep(0.5 * soil.radius, soil.radius, length(at.xz)) : 0.0; }

// The share of a uniform sky that a sphere hides from the ground; `to` goes to its centre.
float capOnGround(vec3 to, float radius) {
  float per = inversesqrt(max(max(dot(to, to), radius * radius), 1e-20));
  return abs(to.y) * radius * radius * per * per * per;
}

// The share of a light's disc that a sphere covers; `to` goes to the sphere's centre. The disc has the half angle `angle`, and is `blur` wider, a length.
float ballShare(float radius, float angle, float blur, vec3 light, vec3 to, float distance2) {
  float along = dot(light, to), away = sqrt(distance2);
  return discShare(radius, angle * away + blur, along, sqrt(max(distance2 - along * along, 0.0)), away);
}

// What surrounds the point `at` with normal `n` of a sphere. `axis` is that of the reflected lobe, of any length; `roughness` and
// `own_color` are those of the sphere's surface.
Surround surroundOf(Listed listed, vec3 at, vec3 n, vec3 axis, float roughness, vec3 own_color, Lobe lobe) {
  axis = normalize(axis);
  float alpha = alphaOfRoughness(roughness), cone = kConeWidth * alpha + 0.005, hidden = 0.0;
  vec3 first = listed.first;
  float reach = listed.reach;
  Soil soil = Soil(listed.is_ground, listed.height, listed.radius, listed.albedo);
  // The ground below is met where the lower part of the lobe meets it.
  float below = soil.is * mix(shareBelow(axis.y, cone), 0.5 - 0.5 * n.y, alpha);
  vec3 ground_at = at + axis * ((at.y - soil.height) / max(-axis.y, max(0.5 * cone, 0.01)));
  ground_at.y = soil.height;
  float ground_blur = cone * length(ground_at - at);
  Surround all = Surround(1.0, vec3(0.0), n, 0.0, 1.0, axis, cone, vec3(0.0), vec3(0.0), vec4(0.0), soil, below, ground_at, surfaceOf(soil, ground_at), vec4(0.0), vec2(1.0), 1.0, 1.0);
  vec3 colors = vec3(0.0), towards = colors;
#ifdef HAS_BRIGHTEST
  float spot_angle = spot_around.w;
#endif
#ifdef HAS_SUN
  vec3 sun_direction = sun_light[0].direction;
  float sun_angle = max(sqrt(max(1.0 - sun_light[0].cos_angle * sun_light[0].cos_angle, 0.0)), 0.002);
#endif
  int i = -1;
  while (i < MOST_NEIGHBOURS - 1) {
    // Goes on to the next sphere that hides anything: it is above the horizon, where lights are, or in the lobe. This loop is short. The code after it
    // runs for such spheres alone, also where lanes go together.
    // Its count goes up first of all: llvmpipe goes on computing for lanes that have left, from the count that they left with.
    bool counts;
    vec4 ball;
    vec3 to;
    float distance2, distance_to, along;
    do {
      ++i;
      ball = textureLod(neighbours, vec2(first.x + float(2 * i) * first.z, first.y), 0.0);
      to = ball.xyz - at;
      distance2 = dot(to, to);
      distance_to = sqrt(distance2);
      along = dot(axis, to);
      float lobe_ends = ball.w + cone * distance_to;
      counts = distance_to < reach * ball.w &&
               (dot(n, to) > -ball.w || (along > -lobe_ends && distance2 - along * along < lobe_ends * lobe_ends));
    } while (i < MOST_NEIGHBOURS - 1 && !counts && ball.w > 0.0);
    if (!counts) break;
    vec4 light = textureLod(neighbours, vec2(first.x + float(2 * i + 1) * first.z, first.y), 0.0);
    float ratio = max(distance_to / ball.w, 1.0), near = withinReach(ratio, reach);
    vec3 matter = unpackMatter(light.a);
    float share = capShare(ratio, dot(n, to) / distance_to) * near;
    // What the ground sees there of this sphere itself, and of others as long as they are above the horizon.
    vec3 over = vec3(ball.x, abs(ball.y - soil.height), ball.z) - vec3(ground_at.x, 0.0, ground_at.z);
    float over2 = dot(over, over), over_by = light.a < 0.0 ? 1.0 : clamp(dot(n, to) / ball.w + 1.0, 0.0, 1.0) * near;
    all.ground_hidden += vec4(light.a < 0.0 ? own_color : light.rgb, 1.0) * (capOnGround(over, ball.w) * over_by);
#ifdef HAS_BRIGHTEST
    all.ground_lit.x *= 1.0 - ballShare(ball.w, spot_angle, ground_blur, lobe.spot, over, over2) * over_by;
#endif
#ifdef HAS_SUN
    all.ground_lit.y *= 1.0 - ballShare(ball.w, sun_angle, ground_blur, sun_direction, over, over2) * over_by;
#endif
    if (light.a < 0.0) {
      all.foot = share * -light.a;
      share = near = 0.0;
    }
    share *= matter.x;
    hidden += share;
    colors += share * light.rgb;
    towards += share / distance_to * to;
    float beside = sqrt(max(distance2 - along * along, 0.0)), wide = cone * distance_to;
    float in_lobe = mix(discShare(ball.w, wide, along, beside, distance_to) * near, share, alpha) * all.mirror_seen;
    all.mirror_seen -= in_lobe;
    all.mirror_albedo += in_lobe * light.rgb;
    // Where the middle of what the lobe and the sphere share meets it.
    float middle = 0.5 * (max(beside - wide, -ball.w) + min(beside + wide, ball.w)), deep = sqrt(max(ball.w * ball.w - middle * middle, 0.0));
    vec3 facing = (axis * along - to) * (middle / max(beside, 1e-6)) - axis * deep;
    float far = max(along - deep, 0.0), alpha_of_it = alphaOfRoughness(matter.y);
    // Over a part of the sphere the mean normal is shorter than 1; over the half that is seen it is 2/3.
    float part = min(wide / ball.w, 1.0);
    all.mirror_facing += facing * (in_lobe / ball.w * (1.0 - part * part * (1.0 / 3.0)));
    all.mirror_matter += vec4(alpha_of_it * alpha_of_it, matter.z, far / ball.w, far) * in_lobe;
#ifdef HAS_BRIGHTEST
    all.spot_seen *= 1.0 - ballShare(ball.w, spot_angle, 0.0, lobe.spot, to, distance2) * near;
#endif
#ifdef HAS_SUN
    all.sun_seen *= 1.0 - ballShare(ball.w, sun_angle, 0.0, sun_direction, to, distance2) * near;
#endif
  }
  all.seen = max(1.0 - hidden, 0.0);
  all.albedo = colors / max(hidden, 1e-6);
  // Over the hemisphere the mean direction is 2/3 n.
  towards = n * (2.0 / 3.0) - towards * ((1.0 - all.seen) / max(hidden, 1e-6));
  all.bent = dot(towards, n) > 0.01 ? normalize(towards) : n;
  return all;
}

// Irradiance over pi of a point with normal n. `sky` is the irradiance map's value in the bent direction, `spot_cosine` its alpha, `below` the value straight down. What hides a
// share of the sky is lit as this point is, so that light goes to and fro: a geometric series (Stewart and Langer, "Towards accurate recovery of shape
// from shading under diffuse lighting", PAMI 1997).
vec3 aroundSeen(Surround surround, vec3 n, Lobe lobe, vec3 sky, float spot_cosine, vec3 below, vec3 ground) {
  vec3 seen = vec3(surround.seen);
  // The ground is there in place of the lower half.
  sky = max(sky + (ground - below) * (0.5 - 0.5 * surround.bent.y), vec3(0.0));
#ifdef HAS_BRIGHTEST
  vec3 spot = spot_around.rgb;
  sky = max(sky - spot * spot_cosine, vec3(0.0));
#endif
#ifndef HAS_PROBES
  seen /= 1.0 - surround.albedo * (1.0 - seen);  // with probes, these give the light that comes back
#endif
  vec3 around = sky * seen;
#ifdef HAS_BRIGHTEST
  around += spot * (max(dot(n, lobe.spot), 0.0) * surround.spot_seen);
#endif
  return max(around - ground * surround.foot, vec3(0.0));
}

const float kOverGround = 0.7;  // least height of an axis above the ground, in widths of the cone: fitted to traced paths

// The share of the sky's light on the ground that spheres leave, with what they throw back: see ground/contact.frag.glsl.
vec3 skyOnGround(Soil soil, vec4 taken) {
  float hidden = min(taken.w, 0.999);  // of white things, all hidden is 0 / 0
  vec3 thrown = min(taken.rgb, vec3(hidden));
  return (1.0 - hidden) * (1.0 + thrown) / (1.0 - hidden * thrown * soil.albedo);
}

// Irradiance over pi of the ground where nothing stands: from the sky, the brightest spot and the sun.
struct GroundLight {
  vec3 sky, spot, sun;
};

// `up` is the irradiance map's value straight up.
GroundLight groundLight(Lobe lobe, vec3 up) {
  GroundLight light = GroundLight(up, vec3(0.0), vec3(0.0));
#ifdef HAS_BRIGHTEST
  light.spot = min(spot_around.rgb * max(lobe.spot.y, 0.0), up);
  light.sky -= light.spot;
#endif
#ifdef HAS_SUN
  light.sun = sun_light[0].irradiance * (max(sun_light[0].direction.y, 0.0) / kPi);
#endif
  return light;
}

// Radiance of the ground: `surface` is the share of its surface in it; the rest is `shown`, darkened as the surface is.
vec3 groundRadiance(Soil soil, GroundLight light, vec3 shown, float surface, vec4 taken, vec2 lit) {
  const vec3 kLuminance = vec3(0.2126, 0.7152, 0.0722);
  vec3 arrives = light.sky * skyOnGround(soil, taken) + light.spot * lit.x + light.sun * lit.y, all = light.sky + light.spot + light.sun;
  return mix(shown * min(dot(arrives, kLuminance) / max(dot(all, kLuminance), 1e-6), 1.0), soil.albedo * arrives, surface);
}

#ifdef HAS_SPECULAR
// The lobe's axis, lifted so far that its cone sees what is above the ground.
vec3 overGround(Surround surround, vec3 axis) {
  axis.y = mix(axis.y, max(axis.y, kOverGround * surround.mirror_width), surround.ground_surface);
  return axis;
}

// The lobe's light without neighbours; `sky` is its light from above the ground.
vec3 skyAndGround(Surround surround, GroundLight light, vec3 sky) {
  return mix(sky, groundRadiance(surround.soil, light, sky, surround.ground_surface, surround.ground_hidden, surround.ground_lit), surround.ground_share);
}

// Light of what hides the rest of the lobe. A metal reflects the sky, the ground, and this sphere, whose light is about `back` there. Anything else is
// taken for a lobe of roughness 1. One place on one sphere stands for all that hides.
vec3 hiddenLight(Surround surround, vec3 at, vec3 n, float radius, vec3 own_color, float own_metallic, float own_alpha, Lobe lobe, GroundLight ground) {
  vec3 sum = vec3(0.0);
  for (int once = surround.mirror_seen < 0.999 ? 1 : 0; once > 0; --once) {
    float hidden = 1.0 - surround.mirror_seen;
    vec3 color = surround.mirror_albedo / hidden, facing = normalize(surround.mirror_facing);
    vec4 matter = surround.mirror_matter / hidden;
    float slant = clamp(-dot(surround.mirror, facing), 0.0, 1.0), away = 1.0 - slant, away2 = away * away;
    color += max(vec3(1.0 - sqrt(sqrt(matter.x))) - color, vec3(0.0)) * (away2 * away2 * away * matter.y);
    vec3 axis = normalize(mix(facing, surround.mirror + 2.0 * slant * facing, matter.y));
    // The lobe of this point, with the width of its pixel, is widened by the other sphere's curvature, then by that sphere's roughness.
    float before = exp2((lobe.maps.y / max(lobe.poles.w, 1.0) - 1.0) * 4.0 * kOctaves), spread = 1.0 + 2.0 * matter.z;
    float alpha = sqrt(clamp(mix(1.0, before * spread * spread + matter.x, matter.y), 1e-6, 1.0)), cone = kConeWidth * alpha + 0.005;
    vec3 place = at + surround.mirror * matter.w;
    float below = surround.soil.is * shareBelow(axis.y, cone), surface = surfaceOf(surround.soil, place);
    // This sphere, as that one sees it.
    vec3 own = at - n * radius, to = own - place;
    float distance2 = dot(to, to), distance_to = sqrt(distance2), along = dot(axis, to);
    float share = mix(discShare(radius, cone * distance_to, along, sqrt(max(distance2 - along * along, 0.0)), distance_to),
                      radius * radius * max(dot(facing, to), 0.0) / (distance2 * distance_to), alpha);
    float deep = sqrt(max(radius * radius - distance2 + along * along, 0.0)), far = max(along - deep, 0.0);
    vec3 own_facing = normalize(axis * far - to), again = reflect(axis, own_facing);
    again = mix(own_facing, again, own_metallic);
    float wider = mix(1.0, min(alpha * (1.0 + 2.0 * far / radius) + own_alpha, 1.0), own_metallic);
    float again_cone = kConeWidth * wider + 0.005, under = surround.soil.is * surface * shareBelow(again.y, again_cone);
    // What this sphere sees there if it counts, then what that one sees: a call is its code again, a turn is not.
    vec3 light = vec3(0.0), back = light;
    for (int turn = share > kLeast ? 2 : 1; turn > 0; --turn) {
      vec3 lifted = turn > 1 ? again : axis;
      lifted.y = mix(lifted.y, max(lifted.y, kOverGround * (turn > 1 ? again_cone : cone)), surface);
      float level = clamp(placeOfAlpha(turn > 1 ? wider : alpha), 0.0, 1.0) * lobe.poles.w;
      back = light;
      light = sampleEquirect(specular, equirectUv(lifted) - vec2(sky_turn, 0.0), equirectLookup(level, lobe.poles.y)).rgb;
    }
    // The ground that it sees, with what it and this sphere hide of that.
    vec3 foot = place + axis * ((place.y - surround.soil.height) / max(-axis.y, max(0.5 * cone, 0.01)));
    foot.y = surround.soil.height;
    float other_radius = matter.w / max(matter.z, 1e-4);
    vec4 taken = vec4(color, 1.0) * capOnGround(place - facing * other_radius - foot, other_radius) + vec4(own_color, 1.0) * capOnGround(own - foot, radius);
    light = mix(light, groundRadiance(surround.soil, ground, light, surface, taken, vec2(max(1.0 - taken.w, 0.0))), below);
    light = mix(light, mix(back, surround.soil.albedo * (ground.sky + ground.spot + ground.sun), under) * own_color, share);
#ifdef HAS_BRIGHTEST
    float half2 = 0.5 + 0.5 * dot(axis, lobe.spot), a2 = min(alpha * alpha + spot_around.w * spot_around.w, 1.0), d = half2 * (a2 - 1.0) + 1.0;
    // Mean of the cosine over the normals that the lobe meets: the shorter their mean, the farther apart they are. So there is no edge where it
    // gets dark. A metal's light ends there by Smith's height-correlated masking.
    vec3 normals = surround.mirror_facing / hidden;
    float cosine = dot(normals, lobe.spot), lit = 0.5 * (cosine + sqrt(cosine * cosine + 0.25 * max(1.0 - dot(normals, normals), 0.0)));
    float masking = lit * sqrt(slant * slant * (1.0 - a2) + a2) + slant * sqrt(lit * lit * (1.0 - a2) + a2);
    float metal = 0.5 * a2 * lit / (d * d * max(masking, 1e-4));
    // This sphere may stand before the light.
    float past = 1.0 - ballShare(radius, spot_around.w, surround.mirror_width * matter.w, lobe.spot, to, distance2);
    light += spot_around.rgb * (mix(lit, metal, matter.y) * past);
#endif
    sum = light * color * hidden;
  }
  return sum;
}
#endif

#endif
