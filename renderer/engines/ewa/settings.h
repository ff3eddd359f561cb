// What can be chosen about the engine `ewa`.
#pragma once

#include "common/scene/choices.h"

namespace relief {

struct EwaSettings {
  EwaFilter filter = EwaFilter::Ewa;
  double cutoff = 1.0;  ///< c of section 4: a kernel ends where its exponent reaches it
  /// l of section 6: fragments per pixel. 1 is the frame buffer of section 4, which keeps the front
  /// surface and knows no transparency.
  int layers = 4;
  double coverage_threshold = 0.4;  ///< tau of section 7: the sum of kernels that covers a pixel
  /// Milliseconds that coarser point sets may be refined for (section 8); 0: all points at once.
  double time_budget_ms = 0.0;
};

}  // namespace relief
