// What differs between a perspective and an orthographic camera. Depths are along the view axis, in
// world units; depth values are reversed: a perspective camera's are near / depth, those of an
// orthographic one linear, from 1 at near on. (Patch and frame tables: shared.h.)

// The direction (world) through a window position, of unit depth.
vec3 ray_through(vec2 window) {
#if (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) != 0u
  return frame.ray_along.xyz;
#else
  return frame.ray_origin.xyz + window.x * frame.ray_x.xyz + window.y * frame.ray_y.xyz;
#endif
}

// The position (world, from the eye) that is seen there at a depth.
vec3 position_through(vec2 window, float depth) {
#if (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) != 0u
  return frame.ray_origin.xyz + window.x * frame.ray_x.xyz + window.y * frame.ray_y.xyz +
         depth * frame.ray_along.xyz;
#else
  return depth * ray_through(window);
#endif
}

// The direction in which a position (grid frame) is seen; `eye`: as the patch's table has it
// (fetch_eye). From the eye to the position, or orthographic of length 1.
vec3 ray_toward(vec3 position, vec4 eye) {
#if (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) != 0u
  return eye.xyz;
#else
  return position - eye.xyz;
#endif
}

// What is `along` times ray_toward() beyond a depth; `spacing`: of the patch.
float depth_beyond(float depth, float along, float spacing) {
#if (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) != 0u
  return depth + along * spacing;
#else
  return depth * (1.0 + along);
#endif
}

float depth_of_value(float value) {
#if (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) != 0u
  return frame.ray_origin.w + (1.0 - value) * frame.ray_along.w;
#else
  return frame.ray_origin.w / value;
#endif
}

// The depth of a fragment of a plane that was rasterised and not set back.
#if (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) != 0u
#define RELIEF_FRAGMENT_DEPTH depth_of_value(gl_FragCoord.z)
#else
#define RELIEF_FRAGMENT_DEPTH (1.0 / gl_FragCoord.w)
#endif

// What sets depth values of something at `depth` back by `behind`, for set_back() below.
float set_back_of(float depth, float behind) {
#if (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) != 0u
  return behind / frame.ray_along.w;
#else
  return depth / (depth + behind);
#endif
}

// None of that.
#if (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) != 0u
const float kNotSetBack = 0.0;
#else
const float kNotSetBack = 1.0;
#endif

// The depth value `z` (or a vertex's, before it is divided by w) set back by both.
float set_back(float z, float by) {
#if (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) != 0u
  return max(z - by, 1e-7);  // a tiny model's splats are set back by more than depth values span
#else
  return z * by;
#endif
}

// By how much the depth value of one surface changes at most from a pixel, where it is `value`, to
// the next: a surface seen at 84 degrees becomes ten pixels deeper, which is a hundredth where a
// pixel is a thousandth of the distance.
float largest_step(float value) {
#if (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) != 0u
  return 10.0 / (frame.ray_x.w * frame.ray_along.w);
#else
  return 0.01 * value;
#endif
}
