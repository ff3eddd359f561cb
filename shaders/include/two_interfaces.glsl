// Glass with two interfaces: where a refracted ray leaves the body, found in an image of the
// surfaces that are seen from behind (Wyman 2005, "An Approximate Image-Space Approach for
// Interactive Refraction"). Its includes stand where it is included: here they would be within an #if.

layout(std140, binding = RELIEF_BIND_BACK_FRAME) uniform BackFrameBlock {
  Frame back_frame;  // the image's camera, with a wider image
};
layout(binding = RELIEF_TEXTURE_BACK_COORDINATES) uniform usampler2D back_coordinates;
layout(binding = RELIEF_TEXTURE_BACK_DEPTHS) uniform sampler2D back_depths;  // 0: nothing
layout(binding = RELIEF_TEXTURE_BODIES) uniform samplerBuffer bodies;

// Of the model that is shaded, its bounding sphere's; whoever shades it sets it.
float body_diameter = 1.0;

// The position (world, from the eye) that the back image shows at a window position and depth.
vec3 back_position(vec2 window, float depth) {
  vec3 through =
      back_frame.ray_origin.xyz + window.x * back_frame.ray_x.xyz + window.y * back_frame.ray_y.xyz;
#if (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) != 0u
  return through + depth * back_frame.ray_along.xyz;
#else
  return depth * through;
#endif
}

// Where the back image shows a position; beyond its border the nearest pixel's middle.
vec2 back_window(vec3 position) {
  float squared = back_frame.ray_x.w * back_frame.ray_x.w;  // pixels are square
#if (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) != 0u
  vec3 off = position - back_frame.ray_origin.xyz;
#else
  vec3 backward = squared * cross(back_frame.ray_x.xyz, back_frame.ray_y.xyz);
  vec3 off = position / max(-dot(position, backward), 1e-20) - back_frame.ray_origin.xyz;
#endif
  vec2 window = squared * vec2(dot(off, back_frame.ray_x.xyz), dot(off, back_frame.ray_y.xyz));
  return clamp(window, vec2(0.5), back_frame.viewport.xy - 0.5);
}

struct BackPoint {
  bool found;
  vec3 position;   // world, from the eye: of the pixel's middle
  vec3 normal;  // world, outward: of the window position, for the patch goes on beside the middle
};

// The surface that is seen from behind in the direction of `position`.
BackPoint find_back(vec3 position) {
  vec2 window = back_window(position);
  ivec2 pixel = ivec2(window);
  float depth = texelFetch(back_depths, pixel, 0).x;
  BackPoint point;
  point.found = depth > 0.0;
  uvec2 found = point.found ? texelFetch(back_coordinates, pixel, 0).xy : uvec2(0u);
  PatchInfo info = fetch_patch(unpack_patch(found));
  point.position = back_position(vec2(pixel) + 0.5, depth);
  vec3 beside = back_position(window, depth) - point.position;
  vec2 shift = vec2(dot(beside, info.axis_u.xyz), dot(beside, info.axis_v.xyz)) / info.axis_u.w;
  vec2 uv = clamp_to_patch(info, unpack_position(found) + shift);
  point.normal = to_world(info, look_up_normal(info, uv, vec4(0.0)));
  return point;
}

// Bends what `split` refracts at `start` (world, from the eye), seen along `ray` under a normal,
// once more where it leaves the body, and gives it the path to there. Where all light is reflected
// within it is not followed further: the environment is seen in the direction that it has then.
void leave_body(vec3 start, vec3 ray, vec3 normal, float ior, inout SplitRay split) {
  vec3 along = split.refracted;
  BackPoint back = find_back(start);
  // What is right in a sphere: there both chords are in the proportion of these cosines.
  float widening = split.path / max(-dot(normal, ray), 0.05);
  float path = back.found ? min(widening * distance(back.position, start), body_diameter) : 0.0;
  vec3 outward = back.found ? back.normal : along;  // nothing there: straight on
  for (int step = 0; step < kExitSteps; ++step) {
    back = find_back(start + path * along);
    if (!back.found) {
      path *= 0.5;
      continue;
    }
    outward = back.normal;
    float facing = dot(outward, along);
    // Where the ray meets the plane there, or comes nearest to its point if it hardly does.
    float ahead = facing > 0.1 ? dot(outward, back.position - start) / facing
                               : dot(along, back.position - start);
    path = clamp(ahead, 0.0, body_diameter);
  }
  SplitRay left = split_within(outward, along, ior);
  // Not 1, which a division may miss.
  split.refracted = left.reflectance < 0.9999 ? left.refracted : left.reflected;
  split.path = path / body_diameter;
}
