// Counting shaded fragments, if the feature is on.
#include "include/shared.h"

#if (RELIEF_FEATURES & RELIEF_FEATURE_COUNT_FRAGMENTS) != 0u
// Storing something would delay the depth test, and then hidden fragments would be shaded too.
#if (RELIEF_FEATURES & (RELIEF_FEATURE_SPRITE | RELIEF_FEATURE_LARGE_SPRITES)) == 0u && \
    !defined(RELIEF_LATE_TESTS)
layout(early_fragment_tests) in;
#endif
layout(std430, binding = RELIEF_BIND_FRAGMENT_COUNT) buffer FragmentCount {
  uint fragment_count;
};
void count_fragment() {
  atomicAdd(fragment_count, 1u);
}
#else
void count_fragment() {}
#endif
