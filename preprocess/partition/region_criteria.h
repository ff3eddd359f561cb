// Tests whether a set of points may share a patch: normal cone and single height.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

#include "common/neighbours/neighbours.h"
#include "common/points.h"
#include "preprocess/normals/normals.h"
#include "preprocess/partition/normal_list.h"

namespace relief {

/// The input of the partition; normals are unit.
struct SurfaceSamples {
  const std::vector<glm::dvec3>& positions;
  const std::vector<glm::vec3>& normals;
  const std::vector<float>& spacing;    ///< local spacing, world units
  const std::vector<float>& roughness;  ///< noise about the local plane, world units
};

/// Points farther apart along their normal than this many local spacings are on two sheets. Points
/// of a smooth sheet are far closer to each other's mean tangent plane, even where it bends
/// strongly; the rest is room for noise.
inline constexpr double kSheetTolerance = 1.1;

/// Returns whether two neighbouring points are on one sheet: similar normals, and each near the
/// other's tangent plane. Connects regions, and separates close sheets. `least_spacing`: that the
/// scan there is known to have at least, world units.
[[nodiscard]] bool on_one_sheet(const SurfaceSamples& samples, std::uint32_t i, std::uint32_t j,
                                float least_spacing = 0.0F);

/// The scale at which sheets in a set of points are distinguished.
struct SheetScale {
  double cell = 0.0;       ///< side of the base plane's cells whose points are compared
  double tolerance = 0.0;  ///< largest distance of two such points from each other's tangent plane
};

/// Returns the scale for some points. `sheet_tolerance`: as in RegionLimits.
[[nodiscard]] SheetScale sheet_scale(const SurfaceSamples& samples,
                                     std::span<const std::uint32_t> points, double sheet_tolerance);

/// Limits of a region.
struct RegionLimits {
  double cone_degrees = 0.0;  ///< largest angle between base-plane normal and point normal
  double sheet_tolerance = kSheetTolerance;  ///< points farther apart than this along the normal,
                                             ///< in spacings of the region, are on two sheets
};

/// Tests point sets; keeps its scratch memory between calls. One object per thread.
class RegionTest {
 public:
  RegionTest(const SurfaceSamples& samples, const RegionLimits& limits);

  /// Returns the base-plane normal with which the points pass both tests, or nothing.
  /// 1. Normal cone (Pauly and Gross 2001, section 3): the mean normal, then, if that fails, the
  ///    axis of the smallest enclosing cone, must have every point's normal within the cone.
  /// 2. Single-valued: points that project into one small cell must lie on one sheet, that is, on
  ///    each other's tangent planes within the tolerance. A cone does not detect parallel layers.
  [[nodiscard]] std::optional<glm::vec3> fit(std::span<const std::uint32_t> points);

  /// Applies only test 1, to the points' unit normals.
  [[nodiscard]] std::optional<glm::vec3> fit_cone(std::span<const std::uint32_t> points);

 private:
  /// Test 2, for the points whose cone was just fitted.
  [[nodiscard]] bool single_valued(std::span<const std::uint32_t> points, glm::vec3 normal);

  /// Whether gathered points in one cell lie on each other's tangent planes. `slot_of`: of each
  /// point's cell in table_.
  template <class SlotOf>
  [[nodiscard]] bool lie_on_one_sheet(const SlotOf& slot_of, double tolerance);

  SurfaceSamples samples_;
  float cos_cone_;
  float cone_;
  double sheet_tolerance_;
  NormalList normals_;
  std::vector<glm::dvec3> positions_;
  std::vector<glm::ivec2> cells_;
  std::vector<std::uint32_t> table_;  // the last point of each cell
  std::vector<std::uint32_t> next_;   // another point of each point's cell
};

}  // namespace relief
