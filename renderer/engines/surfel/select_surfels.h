// Which surfels a frame draws, in what order and with what primitive.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderer/engines/surfel/surfel_set.h"
#include "renderer/surfels/settings.h"
#include "renderer/view/view.h"
#include "shaders/surfel/layout.h"

namespace relief::surfel {

/// How a surfel is drawn; each kind has programs of its own.
enum class SurfelKind : std::uint8_t { Plain, Curved };
inline constexpr std::size_t kSurfelKinds = 2;

/// Surfels that one draw call can draw.
struct SurfelBatch {
  SurfelKind kind = SurfelKind::Plain;
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

struct DrawnSurfels {
  std::vector<shared::DrawnSurfel> list;
  std::vector<SurfelBatch> batches;
};

/// What decides it beside the view.
struct SelectionRule {
  SurfelCurved curved = SurfelCurved::Auto;
  bool hides_backs = false;  ///< what faces away from the eye is not drawn
  bool sorted = false;       ///< back to front by the centres' depth; else kind by kind, by slot
};

/// Chooses them. What the image does not show is left out. With SurfelCurved::Auto, a surfel is
/// curved if the contour of the surface crosses it, bent as it is, and a pixel sees how much it
/// bends. The result does not depend on the number of threads.
[[nodiscard]] DrawnSurfels select_surfels(const SurfelSet& set, const View& view,
                                          const SelectionRule& rule);

/// Whether an eye there sees a closed surface of these surfels from outside.
[[nodiscard]] bool sees_from_outside(const SurfelSet& set, const View& view);

}  // namespace relief::surfel
