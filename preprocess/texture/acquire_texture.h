// From a textured mesh to coloured splats: paper 000, section 5.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "common/error.h"
#include "common/image.h"
#include "common/points.h"
#include "common/progress.h"
#include "preprocess/texture/fit_texture.h"
#include "preprocess/texture/splat_basis.h"

namespace relief {

/// Where the coefficients w_k come from.
enum class Acquisition : std::uint8_t {
  Given,            ///< the texture's value at the point, as a scanner gives a colour per point
  ViewIndependent,  ///< the texture's mean under the splat: view-independent EWA
  Optimised,        ///< the least L2 error, Eq. (11)
};

struct AcquireOptions {
  Acquisition acquisition = Acquisition::Optimised;
  std::size_t points = 100'000;  ///< 1 to kMostTexturedPoints
  double cutoff = 1.0;           ///< that of the engine that draws the splats
  BasisKind basis = BasisKind::Normalised;
};

/// Above, the matrix of the basis at its places (16 places a point, 6.3 entries each) would have
/// more entries than Eigen's 32-bit indices count.
inline constexpr std::size_t kMostTexturedPoints = 8'000'000;

/// Splats with a texture's coefficients. All vectors have the same length. World frame.
struct TexturedSplats {
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;  ///< unit, outward
  /// Linear RGB coefficients. Optimised ones may leave the texture's range: their sum does not.
  std::vector<glm::vec3> colours;
  double deviation =
      0.0;  ///< h of section 5, world units: the square root of the area of one point
};

struct AcquireReport {
  double area = 0.0;              ///< of the mesh, world units squared
  double texels_per_point = 0.0;  ///< how much finer than the points the texture is
  double rms_error = 0.0;  ///< of the function on the splats against the texture, linear light
  std::optional<FitReport> fit;  ///< of Optimised
};

struct AcquireResult {
  TexturedSplats splats;
  AcquireReport report;
};

/// Spreads points over the mesh, evenly but irregularly, and gives them coefficients. Normals that
/// the mesh lacks are made from its triangles. Fails with one sentence: no triangles, no (finite)
/// texture coordinates, no area, a texture without colour, a number of points out of range, an
/// interruption by the user. The result does not depend on the number of threads.
Result<AcquireResult> acquire_texture(Points mesh, const Image& texture,
                                      const AcquireOptions& options, Progress& progress);

}  // namespace relief
