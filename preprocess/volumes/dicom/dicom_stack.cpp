#include "preprocess/volumes/dicom/dicom_stack.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "preprocess/volumes/volume_grid.h"

namespace relief {
namespace {

using std::filesystem::path;

glm::dvec3 vector_of(const std::array<double, 3>& numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

bool is_finite(const std::array<double, 3>& numbers) {
  return std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); });
}

std::string_view series_of(const DicomSlice& slice) {
  return slice.series.data();
}

/// Whether two slices can lie in one stack: programs round directions and spacings.
bool fit(const DicomSlice& a, const DicomSlice& b) {
  constexpr double kRounding = 1e-3;
  const auto near = [](const std::array<double, 3>& x, const std::array<double, 3>& y,
                       double most) { return glm::distance(vector_of(x), vector_of(y)) <= most; };
  return a.size == b.size && a.has_position == b.has_position &&
         near(a.along_row, b.along_row, kRounding) &&
         near(a.along_column, b.along_column, kRounding) &&
         std::abs(a.spacing[0] - b.spacing[0]) <= kRounding * a.spacing[0] &&
         std::abs(a.spacing[1] - b.spacing[1]) <= kRounding * a.spacing[1];
}

/// The files of the series that is meant.
Result<std::vector<std::size_t>> files_of_series(std::span<const path> files,
                                                 std::span<const DicomSlice> slices,
                                                 const path& named) {
  const auto chosen = std::ranges::find(files, named);
  std::map<std::string_view, std::vector<std::size_t>> series;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (slices[i].has_image) series[series_of(slices[i])].push_back(i);
  }
  if (chosen != files.end()) {
    const auto own = static_cast<std::size_t>(chosen - files.begin());
    const DicomSlice& slice = slices[own];
    if (!slice.has_image) {
      return make_error(
          "{}: holds no image of one grey value a pixel, or is damaged; name a file that does",
          named.string());
    }
    // Frames are slices already; a file without a series is alone.
    if (slice.size[2] > 1 || series_of(slice).empty()) return std::vector{own};
    return series[series_of(slice)];
  }
  if (series.empty())
    return make_error("{}: none of its {} files is a DICOM image of one grey value a pixel",
                      named.string(), files.size());
  if (series.size() == 1) return std::move(series.begin()->second);
  std::string found;
  for (const auto& [uid, own] : series) {
    if (found.size() > 200) {
      found += ", ...";
      break;
    }
    found += (found.empty() ? "" : ", ") + files[own.front()].filename().string() + " (" +
             std::to_string(own.size()) + ")";
  }
  return make_error(
      "{}: holds {} DICOM series; name a file of the one to read, instead of the folder: {}",
      named.string(), series.size(), found);
}

/// Places along the stack, and where each slice lies.
struct Places {
  std::vector<double> along;  ///< from the first, mm
  glm::dvec3 direction{0.0};  ///< from slice to slice, unit
  double step = 0.0;          ///< mean, mm
  bool is_even = true;
};

/// Of sorted slices with positions. Fails if they do not lie on a line, or two at one place.
Result<Places> places_of(std::span<const path> files, std::span<const DicomSlice> slices,
                         const std::vector<std::size_t>& order) {
  /// A share of a step: what a table's motor and rounding leave.
  constexpr double kUneven = 0.02;
  const glm::dvec3 first = vector_of(slices[order.front()].position);
  const glm::dvec3 whole = vector_of(slices[order.back()].position) - first;
  const double length = glm::length(whole);
  const auto steps = static_cast<double>(order.size() - 1);
  Places places;
  places.direction = whole / std::max(length, 1e-300);
  places.step = length / steps;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const glm::dvec3 from_first = vector_of(slices[order[i]].position) - first;
    const double along = glm::dot(from_first, places.direction);
    if (i > 0 && !(along - places.along.back() > kUneven * places.step)) {
      return make_error(
          "{} and {}: are slices at the same place, as phases and echoes are; put those of one "
          "into a folder of their own",
          files[order[i - 1]].string(), files[order[i]].filename().string());
    }
    if (glm::length(from_first - along * places.direction) > kUneven * places.step) {
      return make_error("{}: lies beside the line through the other slices; take it out",
                        files[order[i]].string());
    }
    const double due = static_cast<double>(i) * places.step;
    places.is_even = places.is_even && std::abs(along - due) <= kUneven * places.step;
    places.along.push_back(along);
  }
  return places;
}

/// Values without a place: in the order of their numbers.
Result<ScalarVolume> unplaced(const std::string& name, const std::array<std::int64_t, 3>& size,
                              const DicomSlice& slice) {
  glm::dvec3 spacing = vector_of(slice.spacing);
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    if (!(spacing[axis] > 0.0)) spacing[axis] = 1.0;
  }
  return make_volume(name, size, {glm::dvec3(0.0), scaled_axes(glm::dmat3(1.0), spacing)}, {});
}

/// With a place for each slice, at uneven distances.
Result<ScalarVolume> uneven(const std::string& name, const std::array<std::int64_t, 3>& size,
                            const RegularGrid& grid, const Places& places) {
  RELIEF_TRY_ASSIGN(auto volume, make_volume(name, size, grid, kLpsFrame));
  const auto& placed = std::get<RegularGrid>(volume.placement);
  RectilinearGrid rectilinear;
  rectilinear.origin = placed.origin;
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    const double step = glm::length(placed.step[axis]);
    rectilinear.axes[axis] = placed.step[axis] / step;
    if (axis == 2) continue;
    std::vector<double>& own = rectilinear.coordinates[static_cast<std::size_t>(axis)];
    for (glm::uint i = 0; i < volume.size[axis]; ++i) own.push_back(step * i);
  }
  rectilinear.coordinates[2] = places.along;
  volume.placement = std::move(rectilinear);
  return volume;
}

}  // namespace

Result<DicomStack> stack_slices(std::span<const path> files, std::span<const DicomSlice> slices,
                                const path& named) {
  DicomStack stack;
  RELIEF_TRY_ASSIGN(stack.files, files_of_series(files, slices, named));
  std::vector<std::size_t>& order = stack.files;
  const DicomSlice& model = slices[order.front()];
  for (const std::size_t i : order) {
    if (!is_finite(slices[i].position) || !is_finite(slices[i].along_row) ||
        !is_finite(slices[i].along_column))
      return make_error("{}: states a place that is no number; take it out", files[i].string());
    if (slices[i].is_truncated)
      return make_error("{}: is truncated: pixels are missing; copy it again", files[i].string());
    if (fit(model, slices[i])) continue;
    return make_error(
        "{} and {}: are slices of one series, but differ in size, spacing or direction; put those "
        "that fit into a folder of their own",
        files[order.front()].string(), files[i].filename().string());
  }
  std::array<std::int64_t, 3> size = model.size;
  if (order.size() > 1) size[2] = static_cast<std::int64_t>(order.size());
  const std::string name = named.string();
  if (!model.has_position) {
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return slices[i].number; });
    RELIEF_TRY_ASSIGN(stack.volume, unplaced(name, size, model));
    return stack;
  }
  const glm::dvec3 along_row = vector_of(model.along_row);
  const glm::dvec3 along_column = vector_of(model.along_column);
  const glm::dvec3 across = glm::cross(along_row, along_column);
  std::ranges::stable_sort(
      order, {}, [&](std::size_t i) { return glm::dot(across, vector_of(slices[i].position)); });
  RegularGrid grid{vector_of(slices[order.front()].position),
                   {along_row * model.spacing[0], along_column * model.spacing[1],
                    across * (model.spacing[2] > 0.0 ? model.spacing[2] : 1.0)}};
  Places places;
  if (order.size() > 1) {
    RELIEF_TRY_ASSIGN(places, places_of(files, slices, order));
    grid.step[2] = places.direction * places.step;
  }
  if (places.is_even) {
    RELIEF_TRY_ASSIGN(stack.volume, make_volume(name, size, grid, kLpsFrame));
  } else {
    RELIEF_TRY_ASSIGN(stack.volume, uneven(name, size, grid, places));
  }
  return stack;
}

}  // namespace relief
