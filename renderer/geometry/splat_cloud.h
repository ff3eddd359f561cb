// Points as the EWA engine takes them.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <vector>

#include "common/image/image.h"

namespace relief {

/// Points with Gaussian basis functions over their tangent planes ([Zwicker 2001], section 3.1).
/// Every vector is empty or as long as `positions`. World frame.
struct SplatCloud {
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;  ///< unit, outward; always there
  std::vector<double> radii;       ///< h of section 5, world units: variance h^2 I; always there
  std::vector<glm::vec4>
      colours;  ///< linear, not premultiplied; alpha: opacity; empty: neutral grey
  /// On `texture`, v downward; empty without one. NaN: the point is not on it, and has its colour.
  std::vector<glm::vec2> texcoords;
  std::shared_ptr<const Image> texture;  ///< linear; in place of `colours`, for engine `surfel`
  std::vector<glm::vec2> uvs;  ///< grid coordinates on the patch; empty for points of a scan
  std::vector<std::uint32_t> patches;   ///< patch id + 1; empty for points of a scan
  std::vector<std::uint8_t> materials;  ///< index into the table of materials; empty: all 0
};

}  // namespace relief
