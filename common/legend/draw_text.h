// Draws text and rectangles into images: DejaVu Sans, ASCII only.
#pragma once

#include <glm/vec3.hpp>
#include <string_view>

#include "common/image/image.h"

namespace relief {

/// Draws on the channels R, G, B and, if there is one, A of an image (linear, premultiplied).
class Painter {
 public:
  /// The image must have R, G and B, and outlive the painter.
  explicit Painter(Image& image);

  /// Covers pixels from (left, top) up to (right, bottom), which may lie between pixels and outside
  /// of the image. `colour`: linear.
  void fill(double left, double top, double right, double bottom, glm::vec3 colour, float opacity);

  /// Draws text in one line. `x`: left end; `y`: base line; `size`: pixels an em. Other characters
  /// than printable ASCII are drawn as '?'.
  void text(std::string_view text, double x, double y, double size, glm::vec3 colour);

 private:
  void blend(std::size_t pixel, glm::vec3 colour, float opacity);

  Image& image_;
  float* red_ = nullptr;
  float* green_ = nullptr;
  float* blue_ = nullptr;
  float* alpha_ = nullptr;  ///< null: the image is opaque
};

/// Returns the width of a text in ems.
[[nodiscard]] double text_width(std::string_view text);

/// The height of capital letters in ems.
inline constexpr double kCapHeight = 0.729;

}  // namespace relief
