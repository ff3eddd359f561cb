// Whether a set of points may share a patch: the normal cone, and one height over each spot.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/points.h"
#include "preprocess/normals/normals.h"
#include "preprocess/partition/normal_list.h"
#include "preprocess/points/neighbours.h"

namespace relief {

/// What the partition looks at; normals are unit.
struct SurfaceSamples {
  const std::vector<glm::dvec3>& positions;
  const std::vector<glm::vec3>& normals;
  const std::vector<float>& spacing;    ///< local spacing, world units
  const std::vector<float>& roughness;  ///< noise about the local plane, world units
};

/// Points farther apart along their normal than this many local spacings are on two sheets. Points
/// of a smooth sheet leave each other's mean tangent plane by far less, even where it bends
/// strongly; this leaves room for noise.
inline constexpr double kSheetTolerance = 1.1;

/// True if two neighbouring points are on one sheet: like normals, and neither off the other's
/// tangent plane. What connects regions, and what separates sheets that lie close.
[[nodiscard]] bool on_one_sheet(const SurfaceSamples& samples, std::uint32_t i, std::uint32_t j);

/// What tells sheets apart in a set of points.
struct SheetScale {
  double cell = 0.0;       ///< side of the base plane's cells whose points are compared
  double tolerance = 0.0;  ///< how far two of them may be off each other's tangent plane
};

/// `sheet_tolerance`: as in RegionLimits.
[[nodiscard]] SheetScale sheet_scale(const SurfaceSamples& samples,
                                     std::span<const std::uint32_t> points, double sheet_tolerance);

/// How far a region may go.
struct RegionLimits {
  double cone_degrees = 0.0;  ///< largest angle between base-plane normal and point normal
  double sheet_tolerance = kSheetTolerance;  ///< points farther apart than this along the normal,
                                             ///< in spacings of the region, are on two sheets
  double density_ratio = 0.0;  ///< a tenth of the points have this many times the spacing of
                               ///< another tenth, at most; 0: any
};

/// Tests point sets; keeps its scratch memory between calls. One object per thread.
class RegionTest {
 public:
  RegionTest(const SurfaceSamples& samples, const RegionLimits& limits);

  /// The base-plane normal under which the points pass all tests, or nothing.
  /// 1. Normal cone (Pauly and Gross 2001, section 3): the mean normal, then, if that fails, the
  ///    axis of the smallest enclosing cone, must have every point's normal within the cone.
  /// 2. Single-valued: points that project into the same small cell must lie on one sheet, that is,
  ///    on each other's tangent planes within the tolerance. A cone alone lets two parallel layers
  ///    through.
  /// 3. Where asked for, even: the scan's density is alike all over.
  [[nodiscard]] std::optional<glm::vec3> fit(std::span<const std::uint32_t> points);

  /// Test 1 alone, over unit normals that stand for the points.
  [[nodiscard]] std::optional<glm::vec3> fit_cone(std::span<const std::uint32_t> points);

 private:
  [[nodiscard]] bool even_enough(std::span<const std::uint32_t> points);

  /// Of the points whose cone was just fitted.
  [[nodiscard]] bool single_valued(std::span<const std::uint32_t> points, glm::vec3 normal);

  SurfaceSamples samples_;
  float cos_cone_;
  float cone_;
  double sheet_tolerance_;
  double density_ratio_;
  std::vector<float> spacings_;
  NormalList normals_;
  std::vector<glm::dvec3> places_;
  std::vector<std::uint32_t> table_;
  std::vector<std::uint64_t> keys_;
  std::vector<std::uint32_t> next_;
};

/// Two unit vectors that complete a unit normal to a right-handed frame (u, v, n).
void complete_frame(glm::dvec3 n, glm::dvec3& u, glm::dvec3& v);

}  // namespace relief
