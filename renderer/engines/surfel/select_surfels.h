// Which surfels a frame draws, in what order and with what primitive.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/engines/surfel/surfel_set.h"
#include "renderer/settings.h"
#include "renderer/surfels/settings.h"
#include "renderer/view/view.h"
#include "shaders/surfel/layout.h"

namespace relief::surfel {

/// How a surfel is drawn; each kind has programs of its own, so that surfels without clip lines
/// pay nothing for those that have some.
struct SurfelKind {
  bool curved = false;
  bool clipped = false;

  [[nodiscard]] std::size_t index() const { return (curved ? 1U : 0U) + (clipped ? 2U : 0U); }
  bool operator==(const SurfelKind&) const = default;
};
inline constexpr std::array<SurfelKind, 4> kSurfelKinds{
    {{false, false}, {true, false}, {false, true}, {true, true}}};

/// Surfels that one draw call can draw.
struct SurfelBatch {
  SurfelKind kind;
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

struct DrawnSurfels {
  std::vector<shared::DrawnSurfel> list;
  std::vector<SurfelBatch> batches;
};

/// The default of SelectionRule::pixels_per_surfel.
inline constexpr double kPixelsPerSurfel = 1.0;
[[nodiscard]] inline double pixels_per_surfel_of(const RenderSettings& settings) {
  return settings.pixels_per_sample.value_or(kPixelsPerSurfel);
}

/// What decides it beside the view.
struct SelectionRule {
  SurfelCurved curved = SurfelCurved::Auto;
  bool hides_backs = false;  ///< what faces away from the eye is not drawn
  bool sorted = false;       ///< back to front by the centres' depth; else kind by kind, by slot
  /// By slot, whether clip lines cut it; empty: none is.
  std::span<const std::uint8_t> clipped = {};
  bool all_clipped = false;  ///< all are drawn as if lines cut them
  /// The mean surfel of a node is drawn where the node is seen at most so many pixels wide; 0:
  /// never.
  double pixels_per_surfel = 0.0;
};

/// Chooses them. What the image does not show is left out. With SurfelCurved::Auto, a surfel is
/// curved if a flat one would stick out of the contour, and a pixel sees how much it bends. The
/// result does not depend on the number of threads.
[[nodiscard]] DrawnSurfels select_surfels(const SurfelSet& set, const View& view,
                                          const SelectionRule& rule);

/// Whether an eye there sees a closed surface of these surfels from outside.
[[nodiscard]] bool sees_from_outside(const SurfelSet& set, const View& view);

}  // namespace relief::surfel
