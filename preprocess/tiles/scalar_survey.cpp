#include "preprocess/tiles/scalar_survey.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "common/scalars/quantise.h"
#include "common/scalars/scalar_names.h"

namespace relief {

void ScalarSurvey::Column::add(double value) {
  if (std::isnan(value)) return;
  low = has_values ? std::min(low, value) : value;
  high = has_values ? std::max(high, value) : value;
  has_values = true;
  are_whole = are_whole && value == std::floor(value);
  sample.add(value);
}

void ScalarSurvey::take(const Points& block) {
  if (block.size() == 0) return;
  if (std::exchange(is_first_, false)) {
    for (const PointScalar& scalar : block.scalars) columns_.push_back({.name = scalar.name});
  }
  for (const PointScalar& scalar : block.scalars) {
    if (std::ranges::find(columns_, scalar.name, &Column::name) == columns_.end())
      left_out_.insert(scalar.name);
  }
  std::erase_if(columns_, [&](Column& column) {
    const auto scalar = std::ranges::find(block.scalars, column.name, &PointScalar::name);
    if (scalar == block.scalars.end()) {
      left_out_.insert(column.name);
      return true;
    }
    for (const double value : scalar->values) column.add(value);
    column.are_labels = column.are_labels && are_labels(scalar->values);
    return false;
  });
}

std::vector<ScalarInfo> ScalarSurvey::describe() {
  std::vector<ScalarInfo> infos;
  for (Column& column : columns_) {
    if (!column.has_values) continue;
    Quantiles quantiles = *find_quantiles(column.sample.take());
    quantiles.front() = column.low;
    quantiles.back() = column.high;
    const bool is_label = is_label_name(column.name) && column.are_labels;
    infos.push_back(describe_scalar(column.name, is_label, column.are_whole, quantiles));
  }
  return infos;
}

void keep_scalars(std::span<const ScalarInfo> kept, Points& points) {
  std::vector<PointScalar> scalars;
  for (const ScalarInfo& info : kept) {
    const auto found = std::ranges::find(points.scalars, info.name, &PointScalar::name);
    assert(found != points.scalars.end() && "all of the scan's points have it");
    scalars.push_back({info.name, info.is_label, std::move(found->values)});
  }
  points.scalars = std::move(scalars);
}

}  // namespace relief
