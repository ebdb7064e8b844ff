// Direct light from everywhere: the integral over the hemisphere of what shading/brdf.glsl gives for light of radiance 1.
// read    brdf      `as linear`
// write   result    x: Cook-Torrance, y: Blinn-Phong, of a white metal; z, w: of a white dielectric. Along x the cosine of the normal to the
//                   eye, (i + 1) / size, along y roughness, (i + 1/2) / size
#include "shading/brdf.glsl"

in vec2 uv;
out vec4 result;

// Half vectors by tan(theta) = alpha tan(psi), as the lobe is wide; dL = 4 (V.H) dH.
const int kHeights = 96, kAzimuths = 64;

void main() {
  float nv = uv.x + 0.0625, roughness = uv.y, alpha = alphaOfRoughness(roughness);
  vec3 n = vec3(0.0, 0.0, 1.0), v = vec3(sqrt(1.0 - nv * nv), 0.0, nv);
  vec4 sum = vec4(0.0);
  for (int white = 0; white < 2; ++white) {
    Surface surface = Surface(vec3(1.0), white == 0 ? 1.0 : 0.0, roughness);
    Response response = responseOf(surface, nv);
    Response phong = phongResponse(surface, exponentOfRoughness(roughness));
    vec3 d = response.multiple + response.diffuse;
    vec2 total = vec2(0.0);
    for (int i = 0; i < kHeights; ++i) {
      float psi = (float(i) + 0.5) / float(kHeights) * 0.5 * kPi, t = alpha * tan(psi), ch = inversesqrt(1.0 + t * t), sh = t * ch;
      // dH = sin(theta) dtheta dphi, dtheta = alpha / (cos^2 psi + alpha^2 sin^2 psi) dpsi
      float width = alpha / (cos(psi) * cos(psi) + alpha * alpha * sin(psi) * sin(psi)) * 0.5 * kPi / float(kHeights);
      for (int j = 0; j < kAzimuths; ++j) {
        float phi = (float(j) + 0.5) / float(kAzimuths) * kPi;  // even in phi
        vec3 h = vec3(sh * cos(phi), sh * sin(phi), ch), l = 2.0 * dot(v, h) * h - v;
        float share = 4.0 * max(dot(v, h), 0.0) * sh * width * 2.0 * kPi / float(kAzimuths);
        if (l.z <= 0.0) continue;
        // The even parts are integrated in closed form: pi times themselves.
        total.x += share * (cookTorrance(response, n, v, l).r - l.z * d.r / kPi);
        total.y += share * (blinnPhong(phong, n, v, l).r - l.z * phong.diffuse.r / kPi);
      }
    }
    total += vec2(d.r, phong.diffuse.r);
    if (white == 0) sum.xy = total;
    else sum.zw = total;
  }
  result = sum;
}
