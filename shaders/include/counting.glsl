// Counting shaded fragments, if the feature is on.
#include "include/shared.h"

#if (RELIEF_FEATURES & RELIEF_FEATURE_COUNT_FRAGMENTS) != 0u
// Storing something would delay the depth test, and then hidden fragments would be shaded too.
#if (RELIEF_FEATURES & (RELIEF_FEATURE_SPRITE | RELIEF_FEATURE_LARGE_SPRITES)) == 0u && \
    !defined(RELIEF_LATE_TESTS)
layout(early_fragment_tests) in;
#endif
layout(std430, binding = RELIEF_BIND_FRAGMENT_COUNT) buffer FragmentCount {
  uint counts_a_row;  // 0: one count for all pixels
  uint fragment_counts[];
};
void count_fragment() {
  uvec2 pixel = min(uvec2(gl_FragCoord.xy), uvec2(max(counts_a_row, 1u) - 1u, 0xFFFFu));
  atomicAdd(fragment_counts[pixel.y * counts_a_row + pixel.x], 1u);
}
#else
void count_fragment() {}
#endif
