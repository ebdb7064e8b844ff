//!HOOK OUTPUT
//!BIND HOOKED
//!DESC sharpen with the four neighbours

#define STRENGTH 0.75

vec4 hook() {
  vec4 middle = HOOKED_texOff(vec2(0.0));
  vec4 around = HOOKED_texOff(vec2(-1.0, 0.0)) + HOOKED_texOff(vec2(1.0, 0.0)) +
                HOOKED_texOff(vec2(0.0, -1.0)) + HOOKED_texOff(vec2(0.0, 1.0));
  return vec4(clamp(middle.rgb + STRENGTH * (middle.rgb - around.rgb / 4.0), 0.0, 1.0), 1.0);
}
