#include "viewer/measuring/tool.h"

#include <fmt/format.h>

#include <cassert>
#include <utility>

namespace relief {

void MeasuringTool::choose(MeasurementKind kind) {
  chosen_ = kind;
  open_.clear();
}

void MeasuringTool::put_away() {
  chosen_.reset();
  open_.clear();
}

void MeasuringTool::add(const SurfacePoint& point) {
  if (!chosen_) return;
  open_.push_back(point);
  if (*chosen_ != MeasurementKind::Polyline && open_.size() == points_of(*chosen_)) complete();
}

bool MeasuringTool::finish() {
  if (chosen_ != MeasurementKind::Polyline || open_.size() < points_of(*chosen_)) return false;
  complete();
  return true;
}

bool MeasuringTool::escape() {
  if (open_.empty()) return std::exchange(chosen_, std::nullopt).has_value();
  open_.clear();
  return true;
}

bool MeasuringTool::remove_last() {
  if (open_.empty()) return false;
  open_.pop_back();
  return true;
}

std::optional<Measurement> MeasuringTool::preview(const SurfacePoint& next) const {
  if (!chosen_ || open_.empty()) return std::nullopt;
  Measurement measurement{*chosen_, {}, open_};
  measurement.points.push_back(next);
  return is_complete(measurement) ? std::optional(std::move(measurement)) : std::nullopt;
}

void MeasuringTool::rename(std::size_t index, std::string name) {
  assert(index < list_.size());
  list_[index].name = std::move(name);
}

void MeasuringTool::remove(std::size_t index) {
  assert(index < list_.size());
  list_.erase(list_.begin() + static_cast<std::ptrdiff_t>(index));
}

void MeasuringTool::complete() {
  list_.push_back(
      {*chosen_, fmt::format("{} {}", name_of(*chosen_), ++named_), std::exchange(open_, {})});
}

}  // namespace relief
