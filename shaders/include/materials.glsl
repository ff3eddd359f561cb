// What a surface looks like: one function per material, all with linear light.
#include "include/patches.glsl"
#if (RELIEF_FEATURES & RELIEF_FEATURE_MIRROR) != 0u
#include "include/environment.glsl"
#endif

// The normal of a surface as seen along `ray` (unit, from the eye). A back side shows the reversed
// normal. At a silhouette, interpolated normals lean a little away from the eye although the front
// is seen; reversing those would put dark specks on a bright rim, so they are bent to grazing.
vec3 facing_normal(vec3 normal, vec3 ray) {
  float away = dot(normal, ray);
  if (away > 0.6) return -normal;
  return away > 0.0 ? normalize(normal - away * ray) : normal;
}

// Phong: three lights, a white highlight.
vec3 lit(vec3 albedo, vec3 normal, vec3 ray) {
  const float shininess = 40.0;
  const float highlight = 0.25;
  vec3 reflected = reflect(ray, normal);
  vec3 diffuse = frame.light_ambient.rgb;
  vec3 specular = vec3(0.0);
  for (int i = 0; i < kLights; ++i) {
    vec3 colour = frame.light_colour[i].rgb;
    diffuse += colour * max(dot(normal, frame.light_direction[i].xyz), 0.0);
    specular += colour * pow(max(dot(reflected, frame.light_direction[i].xyz), 1e-6), shininess);
  }
  return albedo * diffuse + highlight * specular;
}

#if (RELIEF_FEATURES & RELIEF_FEATURE_MIRROR) != 0u
vec3 mirror(vec3 normal, vec3 ray) {
  return texture(environment, reflect(ray, normal)).rgb;
}
#endif
