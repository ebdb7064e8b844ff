// Rays through the picture, by hierarchical depth (Uludag, "Hi-Z screen-space cone-traced reflections", 2014; rays as lines of the
// picture: McGuire and Mara, "Efficient GPU screen-space ray tracing", JCGT 3(4), 2014).
// Slots: mirror_depth     of all opaque surfaces, reversed-Z
//        mirror_nearest   in each cell of each level the greatest depth there; those of level 0 are 2 x 2 pixels
//        mirror_backs?    depth of the nearest back faces, where what is hit ends; where there is none, it is thin
#ifndef REFLECTIONS_TRACE_GLSL
#define REFLECTIONS_TRACE_GLSL

#include "deferred/gbuffer.glsl"

uniform sampler2D mirror_depth, mirror_nearest;
#ifdef HAS_MIRROR_BACKS
uniform sampler2D mirror_backs;
#endif

const int kSteps = 160;
const float kSame = 0.25;  // pixel widths by which a ray may be behind the surface that it leaves

// Straight lines stay straight: pixels and depth.
vec3 inPicture(vec4 clip) { return vec3((clip.xy / clip.w * 0.5 + 0.5) * viewport, clip.z / clip.w); }

ivec2 inside(ivec2 pixel) { return clamp(pixel, ivec2(0), ivec2(viewport) - 1); }
float depthAt(ivec2 pixel) { return texelFetch(mirror_depth, inside(pixel), 0).r; }
#ifdef HAS_MIRROR_BACKS
float backAt(ivec2 pixel) { return texelFetch(mirror_backs, inside(pixel), 0).r; }
#endif

// As deep as a pixel is wide at a depth.
float depthOfPixel(float there) { return pixelAngle() * (projection[3].w == 0.0 ? there : abs(projection[2].z)); }

// Of the surface at a pixel, per pixel along x and y: the smaller step of the two beside it. Exact on planes.
vec2 depthSlope(ivec2 pixel, float there) {
  vec2 before = there - vec2(depthAt(pixel - ivec2(1, 0)), depthAt(pixel - ivec2(0, 1)));
  vec2 after = vec2(depthAt(pixel + ivec2(1, 0)), depthAt(pixel + ivec2(0, 1))) - there;
  vec2 slope = mix(before, after, lessThan(abs(after), abs(before)));
  return mix(slope, vec2(0.0), greaterThan(abs(slope), vec2(min(64.0 * depthOfPixel(there), 0.25 * there))));
}

// Where a ray from the point `from` of the world meets a surface: pixels and depth, which is 0 where it meets nothing.
vec3 trace(vec3 from, vec3 direction) {
  vec4 clip = view_projection * vec4(from, 1.0), slope = view_projection * vec4(direction, 0.0);
  // To where it vanishes, or to the near plane; in an orthographic view to its near or far one.
  float to_near = (clip.w - 1.01 * near_plane) / max(-slope.w, 1e-4);
  if (projection[3].w != 0.0) to_near = ((slope.z > 0.0 ? 1.0 : 0.0) - clip.z) / (abs(slope.z) > 1e-9 ? slope.z : 1e-9);
  vec4 goal = slope.w > 1e-4 ? slope : clip + slope * to_near;
  vec3 start = inPicture(clip), way = inPicture(goal) - start;
  way.xy = mix(way.xy, vec2(1e-6), lessThan(abs(way.xy), vec2(1e-6)));
  bvec2 onwards = greaterThan(way.xy, vec2(0.0));
  vec2 edges = (mix(vec2(0.0), viewport, onwards) - start.xy) / way.xy;
  float end = min(min(edges.x, edges.y), 1.0), nudge = 0.01 / max(abs(way.x), abs(way.y));

  int level = 0, last = textureQueryLevels(mirror_nearest), i = 0;
  float t = 0.0;
  while (i < kSteps && t < end) {
    // To a pixel whose surface it may go through, in a loop of its own as in probeAlong() of reflections/probe.glsl.
    ivec2 cell;
    float leave, z0, z1, there;
    bool through = false;
    while (i < kSteps && t < end && !through) {
      ++i;
      float side = exp2(float(level));
      cell = ivec2(floor((start.xy + t * way.xy) / side));
      vec2 sides = ((vec2(cell) + vec2(onwards)) * side - start.xy) / way.xy;
      leave = min(max(min(sides.x, sides.y), t) + nudge, end);
      z0 = start.z + t * way.z;
      z1 = start.z + leave * way.z;
      there = level == 0 ? depthAt(cell) : texelFetch(mirror_nearest, cell, level - 1).r;
      bool before = there <= min(z0, z1);
      through = !before && level == 0;
      if (before) t = leave;
      level = before ? min(level + 1, last) : max(level - 1, 0);
    }
    if (!through) break;
    // How far the ray is before the surface's plane, on entering the pixel and on leaving it.
    vec2 across = depthSlope(cell, there), center = vec2(cell) + 0.5;
    float before0 = z0 - there - dot(across, start.xy + t * way.xy - center);
    float before1 = z1 - there - dot(across, start.xy + leave * way.xy - center);
    float width = depthOfPixel(there), same = kSame * width, fall = before0 - before1;
    if (before1 < -same && cell != ivec2(gl_FragCoord.xy)) {
      // It went through the surface here, or at most a pixel before, where the same surface still seemed to be behind it.
      vec2 pixel = normalize(way.xy);
      ivec2 previous = ivec2(floor(start.xy + t * way.xy - pixel));
      bool same_surface = abs(depthAt(previous) - there - dot(across, vec2(previous - cell))) < 4.0 * width;
      if (before0 >= -same || (same_surface && before0 * length((leave - t) * way.xy) >= -fall))
        return start + (t + (leave - t) * clamp(before0 / max(fall, 1e-3 * same), 0.0, 1.0)) * way;
#ifdef HAS_MIRROR_BACKS
      // It came from the side and is in something, whose side the picture does not show but for what is next to its outline. There pixels
      // have some of the light behind.
      float back = backAt(cell);
      if (back > 0.0 && back < there && max(z0, z1) > back) {
        vec2 at = start.xy + t * way.xy;
        if (way.z > 0.0 || there - max(z0, z1) > 6.0 * width) return vec3(0.0);
        return vec3(depthAt(ivec2(floor(at + pixel))) > back ? at + pixel : at, there);
      }
#endif
    }
    t = leave;
  }
  return vec3(0.0);
}

#endif
