#include "preprocess/readers/read_points.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/guard.h"
#include "common/io/file.h"
#include "common/is_finite.h"
#include "preprocess/readers/format.h"
#include "preprocess/readers/gzip/gunzip.h"
#include "preprocess/readers/readers.h"

namespace relief {
namespace {

Bounds finite_bounds(const Points& points) {
  Bounds bounds;
  for (const glm::dvec3& p : points.positions) {
    if (is_finite(p)) extend(bounds, p);
  }
  return bounds;
}

bool has_number(const PointScalar& scalar) {
  return std::ranges::any_of(scalar.values, [](double v) { return std::isfinite(v); });
}

/// Finds out which scalars are labels. Fails if one that is asked for has no value.
Status finish_scalars(const std::string& name, const ScalarChoice& choice,
                      std::vector<PointScalar>& scalars) {
  drop_infinite(scalars);
  for (const std::string& wanted : choice.names) {
    const auto found = std::ranges::find(scalars, wanted, &PointScalar::name);
    if (found == scalars.end() || !has_number(*found))
      return make_error("{}: its scalar {} has no finite number", name, relief::quoted(wanted));
  }
  std::erase_if(scalars, [](const PointScalar& scalar) { return !has_number(scalar); });
  for (PointScalar& scalar : scalars)
    scalar.is_label = is_label_name(scalar.name) && are_labels(scalar.values);
  return {};
}

Result<ReadResult> read_and_clean(const std::filesystem::path& path, std::vector<std::byte> bytes,
                                  Progress& progress, const ReadOptions& options) {
  const std::string name = path.string();
  if (is_gzip(bytes)) {
    RELIEF_TRY_ASSIGN(auto unpacked, gunzip(name, bytes, largest_unpacked(), progress));
    bytes = std::move(unpacked);
  }
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  // The byte order mark that editors on Windows write.
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  if (text.empty()) return make_error("{}: the file is empty", name);
  RELIEF_TRY_ASSIGN(const PointFormat* const format, find_format(path, text, options.format));
  RELIEF_TRY(check_classes(name, *format, options.selection));
  progress.begin_stage("read", text.size());
  ReadRemarks remarks;
  auto points =
      format->read({name, text, progress, remarks, nullptr, &options.selection, &options.scalars});
  if (!points) return points.error();
  RELIEF_TRY(check_scalars(name, options.scalars, remarks));
  bytes = std::vector<std::byte>();  // frees; = {} would keep the memory

  if (options.selection.crop && !points->positions.empty()) {
    const Bounds bounds = finite_bounds(*points);
    remarks.not_selected += crop_points(*points, *options.selection.crop);
    if (points->positions.empty() && !bounds.empty())
      return nothing_in_crop(name, *options.selection.crop, bounds);
  }
  ReadResult result = clean_points(std::move(*points));
  result.points_in_file += remarks.left_out + remarks.not_selected;
  result.left_out = remarks.left_out;
  result.not_selected = remarks.not_selected;
  result.notes = std::move(remarks.notes);
  if (result.points.positions.empty()) {
    return result.dropped_nonfinite == 0
               ? make_error("{}: holds no points", name)
               : make_error("{}: holds no points: the coordinates of all {} are NaN or infinite",
                            name, result.dropped_nonfinite);
  }
  RELIEF_TRY(finish_scalars(name, options.scalars, result.points.scalars));
  return result;
}

}  // namespace

Result<ReadResult> read_bytes(const std::filesystem::path& path, std::vector<std::byte> bytes,
                              Progress& progress, const ReadOptions& options) {
  const std::string name = path.string();
  return guarded({.subject = name,
                  .task = "read it",
                  .advice = "the file may be damaged: write it again, or convert it to PLY",
                  .memory_advice = "convert with --memory"},
                 [&] { return read_and_clean(path, std::move(bytes), progress, options); });
}

Result<ReadResult> read_points(const std::filesystem::path& path, Progress& progress,
                               const ReadOptions& options) {
  RELIEF_TRY_ASSIGN(auto bytes, read_file(path));
  return read_bytes(path, std::move(bytes), progress, options);
}

}  // namespace relief
