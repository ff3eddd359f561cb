#include "preprocess/tiles/spread_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "common/io/standard_input.h"
#include "common/neighbours/neighbours.h"
#include "common/patch_file/scalar_table.h"
#include "preprocess/frame/working_unit.h"
#include "preprocess/points/chance_sample.h"
#include "preprocess/tiles/checkpoint.h"
#include "preprocess/tiles/scalar_survey.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

// Measured: the peak memory of a conversion for each point, with colours and normals, and the
// constant part of the program and file buffers (docs/measurements.md, "Larger than memory").
constexpr std::uint64_t kBytesPerPoint = 450;
// A scalar is kept twice while a tile's points are merged.
constexpr std::uint64_t kBytesPerScalar = 16;
constexpr std::uint64_t kBaseBytes = std::uint64_t{96} << 20U;
// Halos have a tenth as many points as tiles of a million, and half as many as small ones.
constexpr double kHaloShare = 0.5;

// The sample that tells the sides of tiles: a 32nd of all points, so that each of a large scan's
// bodies has enough of them; at least twice a tile's, and no more than are oriented in 20 s.
constexpr std::size_t kSampleShare = 32;
constexpr std::size_t kFewestSamplePoints = std::size_t{1} << 18U;
constexpr std::size_t kMostSamplePoints = std::size_t{1} << 20U;

/// Report of the first run.
struct Look {
  PointSample sample;
  ChanceSample<glm::dvec3, kMostSamplePoints> by_chance;
  Bounds bounds;
  ScanAttributes attributes{true, true};
  ScalarSurvey scalars;
  bool some_normals = false;
  bool some_colours = false;
  std::optional<glm::dvec3> viewpoint;
  Stance stance = kZUp;
  bool is_airborne = true;

  void take(const Points& block) {
    if (block.size() == 0) return;
    for (const glm::dvec3& p : block.positions) {
      sample.add(p);
      by_chance.add(p);
      extend(bounds, p);
    }
    attributes.normals = attributes.normals && !block.normals.empty();
    attributes.colours = attributes.colours && !block.colours.empty();
    some_normals = some_normals || !block.normals.empty();
    some_colours = some_colours || !block.colours.empty();
    scalars.take(block);
    viewpoint = block.viewpoint;
    stance = stance_of(block);
    is_airborne = is_airborne && block.is_airborne;
  }
};

std::uint64_t bytes_of(const std::vector<fs::path>& files) {
  std::uint64_t bytes = 0;
  std::error_code ignored;
  for (const fs::path& file : files) bytes += fs::file_size(input_path(file), ignored);
  return bytes;
}

std::uint64_t bytes_a_point(std::size_t scalars) {
  return kBytesPerPoint + scalars * kBytesPerScalar;
}

std::uint64_t points_for(std::uint64_t memory, std::size_t scalars) {
  return memory > kBaseBytes ? (memory - kBaseBytes) / bytes_a_point(scalars) : 0;
}

/// `scalars`: as a patch file has them.
template <class Scan, class Bytes>
auto scan_fields(Scan& s, Bytes& scalars) {
  return std::tie(s.unit, s.frame, s.layout.cuts, s.layout.tiles, s.layout.largest_halo, s.counts,
                  s.attributes.normals, s.attributes.colours, scalars, s.bounds, s.viewpoint,
                  s.stance, s.is_airborne, s.sample, s.read);
}

/// The scalars of a scan; fails if one that is asked for has no value.
Result<std::vector<ScalarInfo>> describe(ScalarSurvey& survey, const ReadOptions& options,
                                         const std::string& name) {
  std::vector<ScalarInfo> infos = survey.describe();
  for (const std::string& wanted : options.scalars.names) {
    if (std::ranges::find(infos, wanted, &ScalarInfo::name) == infos.end() &&
        !survey.left_out().contains(wanted))
      return make_error("{}: its scalar '{}' has no finite number", name, wanted);
  }
  return infos;
}

/// Some of a sample, evenly over its order: at most as many as a scan of this size needs, and as
/// can be oriented in this memory.
std::vector<glm::dvec3> thinned(const std::vector<glm::dvec3>& sample, std::uint64_t points,
                                std::uint64_t memory) {
  const std::uint64_t most =
      std::min(std::max<std::uint64_t>(points / kSampleShare, kFewestSamplePoints),
               std::max<std::uint64_t>(points_for(memory, 0), 1));
  const std::size_t step = (sample.size() + most - 1) / most;
  std::vector<glm::dvec3> kept;
  for (std::size_t i = 0; i < sample.size(); i += step) kept.push_back(sample[i]);
  return kept;
}

/// The first reading.
Result<Look> look(const std::vector<fs::path>& files, const TileJob& job,
                  const SpreadOptions& options, SpreadScan& scan, Progress& progress) {
  Look seen;
  progress.begin_stage("look", bytes_of(files));
  const auto read = read_blocks(
      files, job.folder(), options.read, options.memory_bytes,
      [&](const Points& block) -> Status {
        seen.take(block);
        return {};
      },
      scan.notes, progress);
  if (!read) return read.error();
  scan.read = *read;
  scan.bounds = seen.bounds;
  scan.attributes = seen.attributes;
  RELIEF_TRY_ASSIGN(scan.attributes.scalars,
                    describe(seen.scalars, options.read, files.front().string()));
  scan.stance = seen.stance;
  // Points seen from several positions have no single viewpoint.
  if (files.size() == 1) scan.viewpoint = seen.viewpoint;
  scan.is_airborne = seen.is_airborne;
  scan.sample = thinned(seen.by_chance.take(), read->points, options.memory_bytes);
  const auto note_mixed = [&](bool some, bool all, std::string_view name) {
    if (some && !all)
      scan.notes.push_back(fmt::format("only some of the scans have {}; they are left out", name));
  };
  note_mixed(seen.some_normals, seen.attributes.normals, "normals");
  note_mixed(seen.some_colours, seen.attributes.colours, "colours");
  for (const std::string& name : seen.scalars.left_out())
    note_mixed(true, false, "the scalar " + name);
  return seen;
}

/// Reads the files again and writes the points of each tile.
Status spread(const std::vector<fs::path>& files, const TileJob& job, const SpreadOptions& options,
              SpreadScan& scan, Progress& progress) {
  TileWriter tiles(job.folder(), scan.layout, scan.attributes);
  progress.begin_stage("spread", bytes_of(files));
  std::vector<std::string> repeated_notes;
  const auto read = read_blocks(
      files, job.folder(), options.read, options.memory_bytes,
      [&](const Points& block) {
        Points moved = block;
        keep_scalars(scan.attributes.scalars, moved);
        to_tiles(scan, moved);
        return tiles.add(moved);
      },
      repeated_notes, progress);
  if (!read) return read.error();
  if (read->points != scan.read.points) {
    return make_error(
        "{}: had {} points at first and now has {}; convert it when it no longer changes",
        files.front().string(), scan.read.points, read->points);
  }
  RELIEF_TRY(tiles.finish());
  scan.counts = tiles.counts();
  return {};
}

/// Chooses the tiles' unit and frame by a sample of the points. Moves all samples there.
void choose_frame(PointSample& sample, SpreadScan& scan) {
  scan.unit = working_unit(sample.points());
  sample.transform([&](const glm::dvec3& p) { return p / scan.unit; });
  scan.frame = working_frame(sample.points());
  const auto move = [&](const glm::dvec3& p) { return to_working_frame(scan.frame, p); };
  sample.transform(move);
  for (glm::dvec3& p : scan.sample) p = move(p / scan.unit);
  if (scan.viewpoint) scan.viewpoint = move(*scan.viewpoint / scan.unit);
}

}  // namespace

void to_tiles(const SpreadScan& scan, Points& points) {
  to_working_unit(points, scan.unit);
  to_working_frame(scan.frame, points);
}

Status save_scan(const fs::path& path, const SpreadScan& scan) {
  const std::vector<std::byte> scalars = write_scalar_table(scan.attributes.scalars);
  return save_checkpoint(path, scan_fields(scan, scalars));
}

Result<SpreadScan> load_scan(const fs::path& path) {
  SpreadScan scan;
  std::vector<std::byte> scalars;
  RELIEF_TRY(load_checkpoint(path, scan_fields(scan, scalars)));
  auto parsed = parse_scalar_table(scalars);
  if (!parsed) return wrong_checkpoint(path);
  scan.attributes.scalars = *std::move(parsed);
  return scan;
}

std::uint64_t memory_for(std::uint64_t points, std::size_t scalars) {
  return kBaseBytes + points * bytes_a_point(scalars);
}

std::uint64_t tile_points(const SpreadOptions& options, std::size_t scalars) {
  const double with_halo = static_cast<double>(points_for(options.memory_bytes, scalars));
  return std::min(static_cast<std::uint64_t>(with_halo / (1.0 + kHaloShare)),
                  options.max_tile_points);
}

Result<std::optional<SpreadScan>> spread_points(const std::vector<fs::path>& files,
                                                const TileJob& job, const SpreadOptions& options,
                                                Progress& progress) {
  if (fs::exists(job.layout())) {
    RELIEF_TRY_ASSIGN(auto known, load_scan(job.layout()));
    return std::optional(std::move(known));
  }
  RELIEF_TRY(job.clear());
  SpreadScan scan;
  RELIEF_TRY_ASSIGN(auto seen, look(files, job, options, scan, progress));
  const std::size_t scalars = scan.attributes.scalars.size();
  const std::uint64_t limit = points_for(options.memory_bytes, scalars);
  if (scan.read.points <= std::max<std::uint64_t>(limit, kMinSurfacePoints))
    return std::optional<SpreadScan>();

  choose_frame(seen.sample, scan);
  scan.layout =
      lay_tiles(seen.sample, tile_points(options, scalars), options.grid_spacing / scan.unit);
  RELIEF_TRY(spread(files, job, options, scan, progress));
  std::uint64_t largest = 0;
  for (const TileCount& count : scan.counts) largest = std::max(largest, count.own + count.halo);
  if (largest > limit) {
    return make_error(
        "{}: --memory must be {} MB or more: {} points are too near to each other "
        "to be cut apart",
        files.front().string(), memory_for(largest, scalars) / 1'000'000 + 1, largest);
  }
  RELIEF_TRY(save_scan(job.layout(), scan));
  return std::optional(std::move(scan));
}

}  // namespace relief
