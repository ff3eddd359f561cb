// What a window can show in place of the picture.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "renderer/settings.h"

namespace relief {

enum class Inspection : std::uint8_t {
  Picture,
  Patches,
  Normals,
  Levels,
  Cells,
  Samples,
  Overdraw,
  Distance,
  Difference
};

/// What a user reads of an inspection.
struct InspectionText {
  const char* name;
  const char* help;
};

/// In the enumerators' order.
inline constexpr std::array<InspectionText, 9> kInspections{
    {{"Picture", "The look, as it is rendered"},
     {"Patches", "Each patch in a colour of its own"},
     {"Normals", "Red, green and blue: x, y and z of the normal in the scan's frame, -1 to 1"},
     {"Levels of detail", "The level that each patch is drawn at"},
     {"Cells",
      "The grid of each patch at its finest level; zoom in where cells are too small to see"},
     {"Samples", "The samples of each patch at its finest level; zoom in where they are too close"},
     {"Overdraw", "Fragments that are shaded a pixel, in all passes that draw the model"},
     {"Distance to the points", "How far the surface is from the nearest point of the scan"},
     {"Difference to truth",
      "How far each pixel is off a ray-traced image of the same view, in 8-bit steps"}}};

[[nodiscard]] inline const InspectionText& text_of(Inspection inspection) {
  return kInspections[static_cast<std::size_t>(inspection)];
}

/// Returns the one that comes `steps`, 1 or -1, after it; the first after the last.
[[nodiscard]] Inspection next_inspection(Inspection inspection, int steps);

/// Returns what shaders/viewer/inspect.frag calls an inspection; none if it does not show it.
[[nodiscard]] std::optional<int> inspected_output(Inspection inspection);

/// Returns the settings that draw what an inspection shows of a look: its outputs, and without
/// materials and a backdrop where these are not seen.
[[nodiscard]] RenderSettings inspected(RenderSettings look, Inspection inspection);

}  // namespace relief
