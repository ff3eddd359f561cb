#include "viewer/choices/text_of.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace relief {
namespace {

/// A ten-thousandth of a box is a tenth of a pixel of its picture.
constexpr int kDigits = 4;

}  // namespace

std::string count_text(std::uint64_t count) {
  std::string digits = std::to_string(count);
  if (digits.size() <= 4) return digits;
  for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3)
    digits.insert(digits.begin() + at, ' ');
  return digits;
}

std::string size_text(std::uint64_t bytes) {
  constexpr std::array<const char*, 4> kUnits{"kB", "MB", "GB", "TB"};
  if (bytes < 1000) return fmt::format("{} bytes", bytes);
  double size = static_cast<double>(bytes) / 1000.0;
  std::size_t unit = 0;
  for (; size >= 999.5 && unit + 1 < kUnits.size(); ++unit) size /= 1000.0;
  return size < 9.95 ? fmt::format("{:.1f} {}", size, kUnits[unit])
                     : fmt::format("{:.0f} {}", size, kUnits[unit]);
}

std::string extent_text(glm::dvec3 sides) {
  return fmt::format("{:.4g} \xC3\x97 {:.4g} \xC3\x97 {:.4g}", sides.x, sides.y, sides.z);
}

std::string position_text(glm::dvec3 position, glm::dvec3 sides) {
  const double largest = std::max({sides.x, sides.y, sides.z});
  const bool is_usable = std::isfinite(largest) && largest > 0.0;
  const double exponent = is_usable ? std::floor(std::log10(largest)) : 0.0;
  const int decimals = static_cast<int>(std::clamp(kDigits - 1.0 - exponent, 0.0, 15.0));
  return fmt::format("{:.{}f}, {:.{}f}, {:.{}f}", position.x, decimals, position.y, decimals,
                     position.z, decimals);
}

}  // namespace relief
