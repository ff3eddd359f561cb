// How far a picture is off another of the same view.
#pragma once

#include <cstdint>
#include <glm/ext/vector_uint4_sized.hpp>
#include <vector>

#include "common/error.h"
#include "common/image/image.h"

namespace relief {

struct DifferenceMap {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<glm::u8vec4> pixels;  ///< sRGB, lower row first, as OpenGL has it
  double psnr_db = 0.0;             ///< colour_psnr_db; infinite without any difference
};

/// Returns the largest difference of the three channels of each pixel, as a display shows them, in
/// the colours of kDifferenceMap from 0 to kMostDifference. `exposure`: stops that both are shown
/// with. Fails, with a clause, if the sizes differ or an image has no colour.
Result<DifferenceMap> map_difference(const Image& shown, const Image& truth, double exposure);

/// Returns the left `share` of the width of one image and the rest of another of the same size and
/// channels: what two looks beside a divider show.
[[nodiscard]] Image join_at(const Image& left, const Image& right, double share);

}  // namespace relief
