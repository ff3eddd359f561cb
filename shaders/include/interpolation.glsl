// Attribute interpolation, section 3.5 of [Ochotta 2008].
#include "include/heights.glsl"

// A position against the virtual triangle under it (grid frame).
struct OverTriangle {
  bool exists;  // false: a corner is a hole
  ivec3 which;  // column and row of its cell; 1: the half below the diagonal
  float above;  // height of the position over the triangle's plane, in cells
  vec2 slope;   // of that plane
};

// All cells are halved along the diagonal from (0, 0) to (1, 1).
ivec3 triangle_under(vec2 position, PatchInfo info) {
  ivec2 cell = clamp(ivec2(floor(position)), ivec2(0), max(info.nodes.xy - 2, ivec2(0)));
  vec2 inside = position - vec2(cell);
  return ivec3(cell, inside.x > inside.y ? 1 : 0);
}

OverTriangle over_triangle(vec3 position, PatchInfo info) {
  OverTriangle over;
  over.which = triangle_under(position.xy, info);
  ivec2 cell = over.which.xy;
  vec2 inside = position.xy - vec2(cell);
  bool lower = over.which.z == 1;
  uint a = fetch_height(info, cell);
  uint b = fetch_height(info, cell + (lower ? ivec2(1, 0) : ivec2(0, 1)));
  uint c = fetch_height(info, cell + ivec2(1, 1));
  float height_step = info.axis_v.w;
  float ab = (float(b) - float(a)) * height_step;
  float bc = (float(c) - float(b)) * height_step;
  over.slope = lower ? vec2(ab, bc) : vec2(bc, ab);
  over.above = position.z - (float(a) * height_step + dot(over.slope, inside));
  over.exists = a != kHoleTexel && b != kHoleTexel && c != kHoleTexel;
  return over;
}

// Moves `hit`, where the view ray along `ray` meets the splat (both in the grid frame), to where
// the ray meets the plane through the elevated corners of the virtual triangle under it. `along`:
// how far along the ray that is, in lengths of `ray`; 0, and `hit` unchanged, where there is no
// triangle. False if the ray passes the surface: the splat sticks out there.
//
// Beyond the paper: where that plane is met over another triangle, that one is tried, and else the
// surface is searched for half a cell at a time. Behind a crest, one step alone was further from a
// ray-traced truth than none. One loop looks at one triangle a pass, as llvmpipe leaves loops early
// but goes through every branch.
bool correct(inout vec3 hit, vec3 ray, PatchInfo info, out float along) {
  float half_cell = 0.5 * inversesqrt(max(dot(ray.xy, ray.xy), 1e-30));
  float eye_side = ray.z < 0.0 ? 1.0 : -1.0;
  vec3 start = hit;
  along = 0.0;
  bool found = true;
  int step = -kSearchSteps - 2;  // two before the search
  float at = 0.0;
  float before = -1.0;  // height of the position before on the eye's side; negative: unknown
  float nearest = kLargestMiss;
  while (step <= kSearchSteps) {
    vec3 position = start + at * ray;
    OverTriangle over = over_triangle(position, info);
    if (step < -kSearchSteps) {
      if (!over.exists) break;
      float next = at + over.above / (dot(over.slope, ray.xy) - ray.z);
      bool near = abs(next) <= half_cell;  // nor where the ray runs along the triangle: 0 / 0
      bool same = near && triangle_under((start + next * ray).xy, info) == over.which;
      bool there = step == -kSearchSteps - 1 && abs(over.above) < kOnSurface;
      if (same || there) {
        along = same ? next : at;
        break;
      }
      bool again = near && step == -kSearchSteps - 2;
      step = again ? step + 1 : -kSearchSteps;
      at = again ? next : -float(kSearchSteps) * half_cell;
      found = again;
    } else {
      bool within = all(greaterThan(position.xy, vec2(-0.5))) &&
                    all(lessThan(position.xy, vec2(info.nodes.xy) - 0.5));
      float outside = within && over.exists ? eye_side * over.above : 1e9;
      if (before >= 0.0 && outside < 0.0) {
        along = at - half_cell * outside / (outside - before);
        found = true;
        break;
      }
      float miss = abs(outside) * inversesqrt(1.0 + dot(over.slope, over.slope));
      if (miss <= nearest) {
        nearest = miss;
        along = at;
        found = true;
      }
      before = within && over.exists ? outside : -1.0;
      ++step;
      at += half_cell;
    }
  }
  hit = start + along * ray;
  return found;
}
