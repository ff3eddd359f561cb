// What can be chosen about the engine `ewa`.
#pragma once

#include <cstdint>

namespace relief {

/// The resampling filters that Figure 8 of paper 000 compares.
enum class EwaFilter : std::uint8_t { Ewa, SourceSpace, Circular, Unfiltered };

struct EwaSettings {
  EwaFilter filter = EwaFilter::Ewa;
  double cutoff = 1.0;              ///< c of section 4: a kernel ends where its exponent reaches it
  int layers = 3;                   ///< l of section 6: fragments per pixel
  double coverage_threshold = 0.4;  ///< tau of section 7
};

}  // namespace relief
