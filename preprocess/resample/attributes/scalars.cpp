#include "preprocess/resample/attributes/scalars.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "common/scalars/quantise.h"
#include "preprocess/resample/attributes/attributes.h"
#include "preprocess/resample/attributes/colour_interpolation.h"

namespace relief {
namespace {

/// A distance that all points of a patch are within, from anywhere on its grid: some samples of
/// sparse patches are far from every point.
double far_reach(const PatchGrid& grid) {
  constexpr double kBeyond = 64.0;  // spacings; the crop may have left some points outside
  return (grid.width + grid.height + kBeyond) * grid.spacing;
}

/// The points that have a value, and the values as shares of the codes: interpolation is that of
/// colours, which are 0 to 1.
struct ValuedPoints {
  PatchPoints points;
  std::vector<glm::vec3> values;
};

ValuedPoints valued_points(const PatchPoints& points, std::size_t count, const PointScalar& scalar,
                           const ScalarInfo& info) {
  ValuedPoints valued;
  for (std::size_t p = 0; p < count; ++p) {
    const std::uint16_t code = code_of(info, scalar.values[points.ids[p]]);
    if (code == kNoScalar) continue;
    valued.points.ids.push_back(points.ids[p]);
    valued.points.positions.push_back(points.positions[p]);
    valued.points.normals.push_back(points.normals[p]);
    valued.points.spacing.push_back(points.spacing[p]);
    valued.values.emplace_back(static_cast<float>(code) / float{kMaxScalarCode});
  }
  return valued;
}

/// Interpolates the numbers of points that all have one.
class NumberInterpolation {
 public:
  NumberInterpolation(const PatchPoints& points, std::size_t count, const PatchGrid& grid,
                      const PointScalar& scalar, const ScalarInfo& info, double step)
      : valued_(valued_points(points, count, scalar, info)), reach_(far_reach(grid)), step_(step) {
    if (valued_.points.size() > 0)
      lookup_.emplace(valued_.points, valued_.points.size(), grid.spacing);
  }

  [[nodiscard]] std::uint16_t at(double x, double y) {
    if (!lookup_) return kNoScalar;
    const std::uint32_t nearest = lookup_->nearest(x, y, reach_);
    if (nearest == PointGrid::kNone) return kNoScalar;
    float share = 0.0F;
    if (valued_.points.spacing[nearest] < step_) {
      share =
          mean_around(valued_.points, *lookup_, {x, y}, nearest, step_, [this](std::uint32_t p) {
            return valued_.values[p];
          }).x;
    } else {
      if (!between_) between_.emplace(valued_.points, *lookup_, valued_.values);
      share = between_->at(x, y, nearest).x;
    }
    const long code = std::lround(share * float{kMaxScalarCode});
    return static_cast<std::uint16_t>(std::clamp(code, 0L, long{kMaxScalarCode}));
  }

 private:
  ValuedPoints valued_;
  std::optional<PointGrid> lookup_;  ///< none: no point has a value
  double reach_;
  double step_;
  std::optional<ColourInterpolation> between_;
};

}  // namespace

AttributeMap<std::uint16_t> sample_scalar(const PatchPoints& points, const PointGrid& lookup,
                                          const std::vector<NodeState>& states,
                                          const PatchGrid& grid, const PointScalar& scalar,
                                          const ScalarInfo& info, std::uint32_t scale) {
  AttributeMap<std::uint16_t> map{
      (grid.width - 1) * scale + 1, (grid.height - 1) * scale + 1, scale, {}};
  map.texels.assign(std::size_t{map.width} * map.height, kNoScalar);
  const double step = grid.spacing / scale;
  std::optional<NumberInterpolation> numbers;
  if (!scalar.is_label) numbers.emplace(points, lookup.size(), grid, scalar, info, step);
  for (std::uint32_t b = 0; b < map.height; ++b) {
    for (std::uint32_t a = 0; a < map.width; ++a) {
      if (!beside_sample(states, grid, a, b, scale)) continue;
      const double x = grid.x0 + a * step;
      const double y = grid.y0 + b * step;
      const std::uint32_t nearest = lookup.nearest(x, y, far_reach(grid));
      if (nearest == PointGrid::kNone) continue;
      const std::uint16_t own = code_of(info, scalar.values[points.ids[nearest]]);
      map.texels[std::size_t{b} * map.width + a] =
          own == kNoScalar || !numbers ? own : numbers->at(x, y);
    }
  }
  return map;
}

std::vector<ScalarInfo> describe_scalars(std::vector<PointScalar>& scalars) {
  std::vector<ScalarInfo> infos;
  std::erase_if(scalars, [&infos](const PointScalar& scalar) {
    auto info = describe_scalar(scalar);
    if (!info) return true;
    infos.push_back(*std::move(info));
    return false;
  });
  return infos;
}

}  // namespace relief
