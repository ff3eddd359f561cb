#include "common/patch_file/compact/rotation_code.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace relief {
namespace {

constexpr std::uint32_t kMask = (1U << 30U) - 1U;
/// The components that are kept are within 1 / sqrt(2).
const double kScale = std::sqrt(2.0) * ((1U << 29U) - 1U);

}  // namespace

RotationCode encode_rotation(const glm::dmat3& axes) {
  const glm::dquat q = glm::normalize(glm::quat_cast(axes));
  const std::array<double, 4> parts{q.w, q.x, q.y, q.z};
  const auto largest = static_cast<std::size_t>(
      std::max_element(parts.begin(), parts.end(),
                       [](double a, double b) { return std::abs(a) < std::abs(b); }) -
      parts.begin());
  const double sign = parts[largest] < 0.0 ? -1.0 : 1.0;
  RotationCode code{};
  std::size_t word = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    if (k == largest) continue;
    const auto rounded = static_cast<std::int32_t>(std::lround(sign * parts[k] * kScale));
    code[word++] = static_cast<std::uint32_t>(rounded) & kMask;
  }
  code[0] |= static_cast<std::uint32_t>(largest) << 30U;
  return code;
}

glm::dmat3 decode_rotation(const RotationCode& code) {
  const std::size_t largest = code[0] >> 30U;
  std::array<double, 4> parts{};
  double squares = 0.0;
  std::size_t word = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    if (k == largest) continue;
    // Up and down again, so that bit 29 is the sign.
    const auto value = static_cast<std::int32_t>(code[word++] << 2U) / 4;
    parts[k] = value / kScale;
    squares += parts[k] * parts[k];
  }
  parts[largest] = std::sqrt(std::max(0.0, 1.0 - squares));
  // A hostile code may be longer than a unit quaternion; the sum of squares makes up for that.
  const auto [w, x, y, z] = parts;
  const double s = 2.0 / (w * w + x * x + y * y + z * z);
  return {1.0 - s * (y * y + z * z), s * (x * y + w * z),       s * (x * z - w * y),
          s * (x * y - w * z),       1.0 - s * (x * x + z * z), s * (y * z + w * x),
          s * (x * z + w * y),       s * (y * z - w * x),       1.0 - s * (x * x + y * y)};
}

}  // namespace relief
