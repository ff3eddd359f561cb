// Pass 1: cuts the triangle down to the parallelogram.
#define RELIEF_LATE_TESTS  // what is cut off must not write its depth
#include "include/counting.glsl"
#include "include/identity.glsl"

layout(location = 0) in vec2 position;
layout(location = 1) in vec2 node;
layout(location = 2) flat in uint hit_patch;

void main() {
  count_fragment();
  if (max(position.x, position.y) > 1.0) discard;
  write_identity(fetch_patch(hit_patch), node);
}
