#include "loader/models/colour_by.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <string>
#include <vector>

#include "common/scalars/paint.h"
#include "common/scalars/quantise.h"

namespace relief {
namespace {

/// Returns the direction of heights, unit: that of `colour_by`, or else the model's own.
glm::dvec3 up_of(const ColourBy& colour_by, const Stance& stance) {
  return glm::normalize(colour_by.up.value_or(stance.up));
}

std::vector<double> heights_of(const ColourBy& colour_by, const Points& points) {
  std::vector<double> heights;
  heights.reserve(points.size());
  const glm::dvec3 up = up_of(colour_by, stance_of(points));
  for (const glm::dvec3& position : points.positions) heights.push_back(glm::dot(position, up));
  return heights;
}

/// The scalar of the points; readers have checked that it is there.
const PointScalar& scalar_of(const ColourBy& colour_by, const Points& points) {
  return *std::ranges::find(points.scalars, colour_by.scalar, &PointScalar::name);
}

/// Says what to do about a model without the scalar.
Error missing_scalar(const std::string& name, const PatchModel& model) {
  std::vector<std::string> names;
  for (const ScalarInfo& scalar : model.scalars) names.push_back(scalar.name);
  return make_error("has no scalar '{}'; it has {}; convert the scan again with --scalars {}", name,
                    names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")), name);
}

}  // namespace

ScalarChoice scalars_for(const ColourBy& colour_by) {
  if (colour_by.scalar == kHeightScalar || colour_by.scalar == kDistanceScalar) return {};
  return {false, {colour_by.scalar}};
}

Result<std::optional<ColourScale>> scale_of_points(const ColourBy& colour_by,
                                                   const Points& points) {
  if (colour_by.scalar == kDistanceScalar) return std::optional<ColourScale>();
  const bool is_height = colour_by.scalar == kHeightScalar;
  const auto quantiles = is_height ? find_quantiles(heights_of(colour_by, points))
                                   : find_quantiles(scalar_of(colour_by, points).values);
  const bool has_labels = !is_height && scalar_of(colour_by, points).is_label;
  RELIEF_TRY_ASSIGN(auto scale, make_colour_scale(colour_by, has_labels, *quantiles));
  return std::optional(std::move(scale));
}

void paint_points(const ColourBy& colour_by, ColourScale& scale, Points& points) {
  const bool is_height = colour_by.scalar == kHeightScalar;
  const std::vector<double> heights =
      is_height ? heights_of(colour_by, points) : std::vector<double>();
  const std::vector<double>& values = is_height ? heights : scalar_of(colour_by, points).values;
  std::set<std::uint32_t> labels;
  points.colours.clear();
  points.colours.reserve(values.size());
  for (const double value : values) {
    points.colours.push_back(std::isnan(value) ? kNoScalarColour : scale.at(value));
    if (scale.is_label && !std::isnan(value)) labels.insert(static_cast<std::uint32_t>(value));
  }
  scale.labels.assign(labels.begin(), labels.end());
}

Result<ColourScale> paint_patches(const ColourBy& colour_by, std::optional<ColourScale> known,
                                  PatchModel& model) {
  if (colour_by.scalar == kHeightScalar) {
    const glm::dvec3 up = up_of(colour_by, model.stance);
    if (!known) {
      RELIEF_TRY_ASSIGN(known, make_colour_scale(colour_by, false, height_quantiles(model, up)));
    }
    paint_heights(*known, up, model);
    return *std::move(known);
  }
  const auto found = std::ranges::find(model.scalars, colour_by.scalar, &ScalarInfo::name);
  if (found == model.scalars.end()) return missing_scalar(colour_by.scalar, model);
  if (!known) {
    RELIEF_TRY_ASSIGN(known, make_colour_scale(colour_by, found->is_label, quantiles_of(*found)));
  }
  paint_scalar(static_cast<std::size_t>(found - model.scalars.begin()), *known, model);
  return *std::move(known);
}

}  // namespace relief
