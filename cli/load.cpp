#include "cli/load.h"

#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "cli/console.h"
#include "cli/paths.h"
#include "common/patch_file.h"
#include "preprocess/convert.h"
#include "renderer/mesh_of_points.h"

namespace relief::cli {
namespace {

/// Appends an attribute if both sides have it for all their points; otherwise neither keeps it.
/// Returns whether something was left out.
template <class T>
bool append_attribute(std::vector<T>& to, std::size_t to_points, const std::vector<T>& from) {
  if (from.empty() != to.empty() && to_points > 0) {
    to.clear();
    return true;
  }
  to.insert(to.end(), from.begin(), from.end());
  return false;
}

/// An attribute once left out stays out, whatever later files have.
struct LeftOut {
  bool normals = false;
  bool colours = false;
  bool texcoords = false;
};

void append(Points& to, Points from, LeftOut& left_out) {
  const auto offset = static_cast<std::uint32_t>(to.size());
  if (left_out.normals) from.normals.clear();
  if (left_out.colours) from.colours.clear();
  if (left_out.texcoords) from.texcoords.clear();
  left_out.normals |= append_attribute(to.normals, offset, from.normals);
  left_out.colours |= append_attribute(to.colours, offset, from.colours);
  left_out.texcoords |= append_attribute(to.texcoords, offset, from.texcoords);
  to.positions.insert(to.positions.end(), from.positions.begin(), from.positions.end());
  to.triangles.reserve(to.triangles.size() + from.triangles.size());
  for (const Triangle& t : from.triangles) {
    to.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  }
  // Points seen from several places have no one viewpoint.
  if (offset == 0) {
    to.viewpoint = from.viewpoint;
  } else if (to.viewpoint != from.viewpoint) {
    to.viewpoint.reset();
  }
}

void note_left_out(const LeftOut& left_out) {
  const auto say = [](bool is_left_out, std::string_view name) {
    if (is_left_out) note(fmt::format("only some of the scans have {}; they are left out", name));
  };
  say(left_out.normals, "normals");
  say(left_out.colours, "colours");
  say(left_out.texcoords, "texture coordinates");
}

/// Whether this version can render such a file at all.
Status check_kind(const std::filesystem::path& path) {
  if (ending(path) != ".json") return {};
  return make_error("{}: this version renders .relief files and scans, no .json scenes yet",
                    path.string());
}

Result<PatchModel> load_patches(const std::filesystem::path& path, Progress& progress) {
  const auto file = PatchFile::open(path);
  if (!file) return file.error();
  return file->read_all(progress);
}

/// Converts the points of a file with the default options.
Result<PatchModel> convert_scan(const std::filesystem::path& path, Points points,
                                Progress& progress) {
  auto converted = convert(std::move(points), {}, progress);
  if (!converted) return make_error("{}: {}", path.string(), converted.error().message);
  return std::move(converted->model);
}

}  // namespace

Result<ReadResult> load_points(const std::vector<std::filesystem::path>& paths,
                               Progress& progress) {
  if (paths.size() == 1) return read_points(paths.front(), progress);
  ReadResult all;
  LeftOut left_out;
  for (const auto& path : paths) {
    auto scan = read_points(path, progress);
    if (!scan) return scan.error();
    all.points_in_file += scan->points_in_file;
    all.dropped_nonfinite += scan->dropped_nonfinite;
    all.merged_duplicates += scan->merged_duplicates;
    if (all.points.size() + scan->points.size() > UINT32_MAX) {
      return make_error("{}: with it the scans have more than {} points; convert fewer at a time",
                        path.string(), UINT32_MAX);
    }
    append(all.points, std::move(scan->points), left_out);
  }
  note_left_out(left_out);
  ReadResult cleaned = clean_points(std::move(all.points));
  all.points = std::move(cleaned.points);
  all.merged_duplicates += cleaned.merged_duplicates;
  return all;
}

Result<PatchModel> load_model(const std::filesystem::path& path, Progress& progress) {
  const Status known = check_kind(path);
  if (!known) return known.error();
  if (ending(path) == ".relief") return load_patches(path, progress);
  auto scan = read_points(path, progress);
  if (!scan) return scan.error();
  return convert_scan(path, std::move(scan->points), progress);
}

Result<TraceableModel> load_traceable(const std::filesystem::path& path, Progress& progress) {
  const auto of_patches = [](Result<PatchModel> model) -> Result<TraceableModel> {
    if (!model) return model.error();
    const Bounds bounds = model->bounds;
    const double radius = model->bounding_radius;
    return TraceableModel{std::move(*model), bounds, radius};
  };
  const Status known = check_kind(path);
  if (!known) return known.error();
  if (ending(path) == ".relief") return of_patches(load_patches(path, progress));
  auto scan = read_points(path, progress);
  if (!scan) return scan.error();
  if (scan->points.triangles.empty())
    return of_patches(convert_scan(path, std::move(scan->points), progress));
  const std::vector<glm::dvec3>& positions = scan->points.positions;
  const Bounds bounds = bounds_of(positions);
  return TraceableModel{mesh_of_points(scan->points), bounds, bounding_radius(positions, bounds)};
}

}  // namespace relief::cli
