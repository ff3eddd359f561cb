// Light as sRGB encodes it.

vec3 srgb_of(vec3 linear) {
  vec3 light = clamp(linear, 0.0, 1.0);
  return mix(12.92 * light, 1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055,
             greaterThan(light, vec3(0.0031308)));
}
