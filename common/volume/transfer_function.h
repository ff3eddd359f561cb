// What a value of a volume looks like: colour and opacity.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "common/error.h"
#include "common/volume/scalar_volume.h"

namespace relief {

struct ColourStop {
  double value = 0.0;
  glm::vec3 colour{1.0F};  ///< linear
};

/// Of TransferFunction::opacities: the opacity of a layer of the unit length. Of gradients: a
/// factor of the extinction.
struct OpacityStop {
  double at = 0.0;
  double opacity = 0.0;  ///< 0 to kMaxOpacity
};

/// Below 1: nothing has an infinite extinction.
inline constexpr double kMaxOpacity = 0.9999;

/// Piecewise linear functions of the value; the first and the last stop go on beyond them.
struct TransferFunction {
  std::vector<ColourStop> colours;     ///< ascending, at least one
  std::vector<OpacityStop> opacities;  ///< ascending, at least one
  /// Over the gradient's magnitude (values for a world unit); empty: 1 everywhere.
  std::vector<OpacityStop> gradients;
  double unit_length = 1.0;  ///< world units, above 0
};

[[nodiscard]] glm::vec3 colour_at(const TransferFunction& function, double value);

/// The extinction for a world unit: -ln(1 - opacity) / unit length, times the gradient's factor. 0
/// for a value that is NaN.
[[nodiscard]] double extinction_at(const TransferFunction& function, double value,
                                   double gradient_magnitude);

/// Whether all that has this value is transparent, whatever its gradient.
[[nodiscard]] bool is_transparent_at(const TransferFunction& function, double value);

/// Names of functions that come with Relief.
[[nodiscard]] std::span<const std::string_view> transfer_presets();

/// What `--transfer` names: "auto" (from the histogram), a preset, or a JSON file
/// (docs/volumes.md). Fails with one sentence if it is neither.
Result<TransferFunction> transfer_function_for(std::string_view name, const ScalarVolume& volume);

/// Shows what is above the background of the volume (its values' histogram, by Otsu's threshold):
/// faint where values are low, opaque where they are high.
[[nodiscard]] TransferFunction transfer_from_histogram(const ScalarVolume& volume);

Result<TransferFunction> read_transfer_function(const std::filesystem::path& path,
                                                double default_unit_length);

}  // namespace relief
