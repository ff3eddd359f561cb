// Scalars of a scan beside positions and colours: intensity, class, return, confidence ...
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace relief {

/// A number for each point of a scan; NaN where the file has none.
struct PointScalar {
  std::string name;  ///< as canonical_scalar_name() has it
  /// The numbers are names, such as classes: they have no order and are never interpolated. Whole,
  /// from 0 to 65534.
  bool is_label = false;
  std::vector<double> values;
};

/// The code of a texel without a value.
inline constexpr std::uint16_t kNoScalar = 65535;
inline constexpr std::uint16_t kMaxScalarCode = 65534;
/// The largest number of scalars that a scan and a patch file keep.
inline constexpr std::size_t kMaxScalars = 32;
inline constexpr std::size_t kMaxScalarName = 63;

/// Scalars that are computed and not read.
inline constexpr const char* kHeightScalar = "height";
inline constexpr const char* kDistanceScalar = "distance";  ///< of samples to the nearest point

/// The values below which 0, 1 ... 100 % of a scalar's values lie, ascending.
using Quantiles = std::array<double, 101>;

/// A scalar of a patch model. Patches hold codes of 16 bits.
struct ScalarInfo {
  std::string name;  ///< printable, 1 to kMaxScalarName bytes
  bool is_label = false;
  double offset = 0.0;                         ///< the value of code 0
  double step = 1.0;                           ///< from one code to the next; above 0
  std::array<std::uint16_t, 101> quantiles{};  ///< codes, at most kMaxScalarCode, ascending

  /// Returns the value of a code other than kNoScalar.
  [[nodiscard]] double value_of(std::uint16_t code) const { return offset + step * code; }
  [[nodiscard]] bool operator==(const ScalarInfo&) const = default;
};

/// Returns the quantiles as values.
[[nodiscard]] inline Quantiles quantiles_of(const ScalarInfo& scalar) {
  Quantiles values{};
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = scalar.value_of(scalar.quantiles[k]);
  return values;
}

}  // namespace relief
