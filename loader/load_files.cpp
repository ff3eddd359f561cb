#include "loader/load_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "common/image/srgb.h"
#include "common/io/extension.h"
#include "common/io/file.h"
#include "common/mesh/footing.h"
#include "common/neighbours/neighbours.h"
#include "common/patch_file/patch_file.h"
#include "preprocess/convert.h"
#include "preprocess/normals/normals.h"
#include "preprocess/points/point_radii.h"
#include "preprocess/raster/convert_raster.h"
#include "preprocess/raster/raster.h"
#include "preprocess/readers/scan_poses.h"

namespace relief {
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

/// An attribute that was left out once stays out, even if later files have it.
struct LeftOut {
  bool normals = false;
  bool colours = false;
  bool texcoords = false;
  std::set<std::string> scalars;
};

/// Keeps the scalars that all scans have.
void append_scalars(Points& to, Points& from, LeftOut& left_out) {
  const auto named = [](Points& points, const std::string& name) {
    return std::ranges::find(points.scalars, name, &PointScalar::name);
  };
  if (to.positions.empty()) {
    to.scalars = std::move(from.scalars);
    return;
  }
  for (const PointScalar& scalar : from.scalars) {
    if (named(to, scalar.name) == to.scalars.end()) left_out.scalars.insert(scalar.name);
  }
  std::erase_if(to.scalars, [&](PointScalar& scalar) {
    const auto more = named(from, scalar.name);
    if (more == from.scalars.end()) {
      left_out.scalars.insert(scalar.name);
      return true;
    }
    scalar.values.insert(scalar.values.end(), more->values.begin(), more->values.end());
    scalar.is_label = scalar.is_label && more->is_label;
    return false;
  });
}

/// Triangles keep their materials, and their texture coordinates with them, which by point may have
/// been left out.
void append_materials(Points& to, Points& from) {
  if (from.materials.empty() && to.materials.empty()) {
    to.corner_texcoords.clear();
    return;
  }
  const auto give_corners = [](Points& points) {
    if (!points.corner_texcoords.empty()) return;
    points.corner_texcoords.resize(points.triangles.size());
    if (points.texcoords.empty()) return;
    for (std::size_t t = 0; t < points.triangles.size(); ++t)
      points.corner_texcoords[t] = texcoords_of(points, t);
  };
  give_corners(to);
  give_corners(from);
  to.corner_texcoords.insert(to.corner_texcoords.end(), from.corner_texcoords.begin(),
                             from.corner_texcoords.end());
  if (!to.corner_tangents.empty() || !from.corner_tangents.empty()) {
    to.corner_tangents.resize(to.triangles.size(), CornerTangents{});
    from.corner_tangents.resize(from.triangles.size(), CornerTangents{});
    to.corner_tangents.insert(to.corner_tangents.end(), from.corner_tangents.begin(),
                              from.corner_tangents.end());
  }
  const auto before = static_cast<std::uint32_t>(to.materials.size());
  to.triangle_materials.resize(to.triangles.size(), kNoMaterial);
  from.triangle_materials.resize(from.triangles.size(), kNoMaterial);
  for (const std::uint32_t material : from.triangle_materials)
    to.triangle_materials.push_back(material == kNoMaterial ? material : material + before);
  to.materials.insert(to.materials.end(), from.materials.begin(), from.materials.end());
}

/// Gives each point its scanner, if the scan has a viewpoint or scanners.
void give_scanners(Points& scan) {
  if (!scan.viewpoint) return;
  scan.scanners = {*scan.viewpoint};
  scan.scanner_of.assign(scan.size(), 0);
}

/// Points seen from several positions have no single viewpoint, but each its scanner, if all files
/// tell. `to` has its own points still.
void append_scanners(Points& to, Points& from) {
  if (to.size() == 0) {
    to.viewpoint = from.viewpoint;
    to.scanners = std::move(from.scanners);
    to.scanner_of = std::move(from.scanner_of);
    return;
  }
  if (to.viewpoint && to.viewpoint == from.viewpoint) return;
  give_scanners(to);
  give_scanners(from);
  to.viewpoint.reset();
  const std::size_t before = to.scanners.size();
  if (to.scanner_of.empty() || from.scanner_of.empty() ||
      before + from.scanners.size() > std::size_t{UINT16_MAX} + 1) {
    to.scanners.clear();
    to.scanner_of.clear();
    return;
  }
  to.scanners.insert(to.scanners.end(), from.scanners.begin(), from.scanners.end());
  for (const std::uint16_t scanner : from.scanner_of)
    to.scanner_of.push_back(static_cast<std::uint16_t>(scanner + before));
}

void append(Points& to, Points from, LeftOut& left_out) {
  const auto offset = static_cast<std::uint32_t>(to.size());
  if (left_out.normals) from.normals.clear();
  if (left_out.colours) from.colours.clear();
  if (left_out.texcoords) from.texcoords.clear();
  to.is_airborne = from.is_airborne && (offset == 0 || to.is_airborne);
  append_scanners(to, from);
  left_out.normals |= append_attribute(to.normals, offset, from.normals);
  left_out.colours |= append_attribute(to.colours, offset, from.colours);
  left_out.texcoords |= append_attribute(to.texcoords, offset, from.texcoords);
  append_scalars(to, from, left_out);
  to.positions.insert(to.positions.end(), from.positions.begin(), from.positions.end());
  append_materials(to, from);
  to.triangles.reserve(to.triangles.size() + from.triangles.size());
  for (const Triangle& t : from.triangles) {
    to.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  }
  if (offset == 0) to.stance = from.stance;
  // Of several images, none is the one to look at first.
  if (offset > 0 && to.stance) to.stance->is_from_sensor = false;
}

void note_left_out(const LeftOut& left_out, Progress& progress) {
  const auto note_if = [&progress](bool is_left_out, std::string_view name) {
    if (!is_left_out) return;
    progress.note(fmt::format("only some of the scans have {}; they are left out", name));
  };
  note_if(left_out.normals, "normals");
  note_if(left_out.colours, "colours");
  note_if(left_out.texcoords, "texture coordinates");
  for (const std::string& name : left_out.scalars) note_if(true, "the scalar " + name);
}

/// Lets a mesh stand as it can, if its file does not say how.
void stand_up(Points& mesh) {
  if (!mesh.stance && stands_on_z(mesh)) mesh.stance = kZUp;
}

Result<ReadResult> read_mesh(const std::filesystem::path& path, const TextureChoice& textures,
                             Progress& progress, const ReadOptions& options) {
  auto read = read_points(path, progress, options);
  if (!read) return read;
  std::vector<std::string> notes = std::move(read->notes);
  const Status loaded = load_textures(path, textures, read->points, notes);
  for (const std::string& text : notes) progress.note(text);
  if (!loaded) return loaded.error();
  return read;
}

/// A file, and the pose of its points if a .conf file names one.
struct ScanFile {
  std::filesystem::path path;
  std::optional<ScanPose> pose;
};

/// The files, with each .conf file replaced by the scans that it names.
Result<std::vector<ScanFile>> list_scans(const std::vector<std::filesystem::path>& paths) {
  std::vector<ScanFile> scans;
  for (const auto& path : paths) {
    if (lower_extension(path) != ".conf") {
      scans.push_back({path, std::nullopt});
      continue;
    }
    RELIEF_TRY_ASSIGN(const auto bytes, read_file(path));
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    RELIEF_TRY_ASSIGN(const auto poses, read_scan_poses(path.string(), text));
    for (const ScanPose& pose : poses) {
      RELIEF_TRY_ASSIGN(const auto scan, find_scan(path, pose));
      scans.push_back({scan, pose});
    }
  }
  return scans;
}

}  // namespace

Result<ReadResult> load_mesh(const std::filesystem::path& path, const TextureChoice& textures,
                             Progress& progress, const ReadOptions& options) {
  auto read = read_mesh(path, textures, progress, options);
  if (read) stand_up(read->points);
  return read;
}

Result<ReadResult> load_points(const std::vector<std::filesystem::path>& paths,
                               const TextureChoice& textures, Progress& progress,
                               const ReadOptions& options) {
  const auto scans = list_scans(paths);
  if (!scans) return scans.error();
  for (const ScanFile& scan : *scans) {
    if (is_raster(scan.path, options.format)) {
      return make_error(
          "{}: is a raster, which is converted alone; join rasters with `gdalwarp A.tif B.tif "
          "OUT.tif`",
          scan.path.string());
    }
  }
  if (scans->size() == 1 && !scans->front().pose)
    return load_mesh(paths.front(), textures, progress, options);
  ReadResult all;
  LeftOut left_out;
  // Poses move points into the frame of the crop. Several files need not all have points in it.
  ReadOptions of_file = options;
  of_file.selection.crop.reset();
  Bounds bounds;
  for (const auto& [path, pose] : *scans) {
    RELIEF_TRY_ASSIGN(auto scan, read_mesh(path, textures, progress, of_file));
    if (pose) place_scan(*pose, scan.points);
    if (options.selection.crop) {
      for (const glm::dvec3& p : scan.points.positions) extend(bounds, p);
      all.not_selected += crop_points(scan.points, *options.selection.crop);
    }
    all.points_in_file += scan.points_in_file;
    all.dropped_nonfinite += scan.dropped_nonfinite;
    all.left_out += scan.left_out;
    all.not_selected += scan.not_selected;
    all.merged_duplicates += scan.merged_duplicates;
    if (all.points.size() + scan.points.size() > UINT32_MAX) {
      return make_error("{}: with it the scans have more than {} points; convert fewer at a time",
                        path.string(), UINT32_MAX);
    }
    append(all.points, std::move(scan.points), left_out);
  }
  if (options.selection.crop && all.points.positions.empty())
    return nothing_in_crop(paths.front().string(), *options.selection.crop, bounds);
  note_left_out(left_out, progress);
  stand_up(all.points);
  ReadResult cleaned = clean_points(std::move(all.points));
  all.points = std::move(cleaned.points);
  all.merged_duplicates += cleaned.merged_duplicates;
  return all;
}

Result<ReadPatches> load_patches(const std::filesystem::path& path, Progress& progress,
                                 const ReadOptions& options, const PatchSections& sections) {
  if (options.selection.selects()) {
    return make_error(
        "{}: is a patch file, which has no points to select; convert its scan with --classes, "
        "--returns or --crop",
        path.string());
  }
  RELIEF_TRY_ASSIGN(const auto file, PatchFile::open(path));
  RELIEF_TRY_ASSIGN(auto model, file.read_all(progress, sections));
  return ReadPatches{std::move(model), file.bytes_read()};
}

Result<PatchModel> load_model(const std::filesystem::path& path, Progress& progress,
                              const ReadOptions& options, const TextureChoice& textures) {
  if (names_patch_file(path)) {
    RELIEF_TRY_ASSIGN(auto read, load_patches(path, progress, options, {}));
    return std::move(read.model);
  }
  if (is_raster(path, options.format)) {
    RELIEF_TRY_ASSIGN(auto raster, convert_raster(path, textures, {}, options, progress));
    return std::move(raster.model);
  }
  auto scan = load_mesh(path, {}, progress, options);
  if (!scan) return scan.error();
  auto converted = convert(std::move(scan->points), {}, progress);
  if (!converted) {
    return make_error("{}: {}", path.string(), converted.error().message);
  }
  return std::move(converted->model);
}

Result<SplatCloud> splats_of_points(Points points, Progress& progress) {
  if (points.size() < kMinSurfacePoints) {
    return make_error("the scan has {} distinct points; at least {} are needed to find a surface",
                      points.size(), kMinSurfacePoints);
  }
  progress.begin_stage("neighbours", 0);
  const NeighbourGraph graph = find_neighbours(points.positions, kSurfaceNeighbours);
  if (progress.cancelled()) return interrupted_error();
  progress.begin_stage("normals", 0);
  complete_normals(points, graph, fit_local_frames(points.positions, graph), {}, progress);
  if (progress.cancelled()) return interrupted_error();
  SplatCloud cloud;
  cloud.radii = find_radii(graph);
  cloud.colours.reserve(points.colours.size());
  for (const glm::u8vec3 srgb : points.colours)
    cloud.colours.emplace_back(linear_from_srgb8(srgb), 1.0F);
  cloud.positions = std::move(points.positions);
  cloud.normals = std::move(points.normals);
  return cloud;
}

}  // namespace relief
