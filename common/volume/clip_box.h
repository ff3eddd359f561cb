// Boxes that volumes and 3D Gaussians are cut to.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "common/bounds.h"
#include "common/error.h"

namespace relief {

/// A side of a clip box: a world coordinate, or the percentage of the model's extent below it.
struct ClipSide {
  double number = 0.0;
  bool is_percent = false;

  bool operator==(const ClipSide&) const = default;
};

/// A box along the world's axes.
struct ClipBox {
  std::array<ClipSide, 3> low;
  std::array<ClipSide, 3> high;

  bool operator==(const ClipBox&) const = default;
};

/// What a clip box is written as, for messages.
inline constexpr std::string_view kClipBoxForm =
    "X0,Y0,Z0,X1,Y1,Z1, each a coordinate or a percentage as in 50%, the lower corner first";

/// "0,0,0,50%,100%,100%": the lower and the upper corner. None if the text is no such box, a
/// coordinate is not finite, a percentage not from 0 to 100, or an upper side below the lower one
/// of its kind.
[[nodiscard]] std::optional<ClipBox> parse_clip_box(std::string_view text);

/// The text that parse_clip_box() reads as this box.
[[nodiscard]] std::string text_of(const ClipBox& box);

/// The box in world coordinates. A lower side at 0 % and an upper side at 100 % are infinite, so
/// that they cut nothing off. `extent`: of the model; not empty. Fails, with a sentence, if the box
/// is empty or does not touch the extent.
Result<Bounds> place_clip_box(const ClipBox& box, const Bounds& extent);

/// Whether a place lies in it, its sides included.
[[nodiscard]] inline bool holds(const Bounds& box, glm::dvec3 place) {
  return place.x >= box.min.x && place.y >= box.min.y && place.z >= box.min.z &&
         place.x <= box.max.x && place.y <= box.max.y && place.z <= box.max.z;
}

}  // namespace relief
