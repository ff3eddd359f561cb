#include "preprocess/raster/convert_raster.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/guard.h"
#include "preprocess/raster/drape.h"
#include "preprocess/raster/even_raster.h"
#include "preprocess/raster/height_steps.h"
#include "preprocess/raster/raster_tile.h"
#include "preprocess/thread_limit.h"

namespace relief {
namespace {

/// Cells along a patch's side: large enough that borders are few, small enough for culling and
/// levels of detail.
constexpr std::uint32_t kTileCells = 256;
/// Cells that patches share beyond their border: the levels of neighbours may differ.
constexpr std::uint32_t kOverlapCells = 1;
constexpr std::uint32_t kMostTexelsPerCell = 16;  ///< by default
/// Steps of heights that are no decimal numbers, between the lowest and the highest of all.
constexpr double kStepsOfAll = 60000.0;
/// A cell of a patch takes so many bytes beside its colours, and a texel three.
constexpr double kBytesPerCell = 9.0;

double memory_of_machine() {
  return static_cast<double>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<double>(::sysconf(_SC_PAGESIZE));
}

/// The cells whose centres lie in the crop.
Result<RasterWindow> window_of(const RasterInfo& info, const std::optional<Bounds>& crop) {
  RasterWindow window{0, 0, info.columns, info.rows};
  if (!crop) return window;
  const GeoGrid& g = info.grid;
  const auto range = [](double low, double high, std::uint32_t count) {
    const double first = std::max(std::ceil(low - 1e-9), 0.0);
    const double last = std::min(std::floor(high + 1e-9), count - 1.0);
    return std::pair(first, last);
  };
  const auto [west, east] =
      range((crop->min.x - g.x) / g.dx, (crop->max.x - g.x) / g.dx, info.columns);
  const auto [north, south] =
      range((g.y - crop->max.y) / g.dy, (g.y - crop->min.y) / g.dy, info.rows);
  if (!(east - west >= 1.0 && south - north >= 1.0)) {
    const Bounds all{{g.x, g.y - (info.rows - 1) * g.dy, -INFINITY},
                     {g.x + (info.columns - 1) * g.dx, g.y, INFINITY}};
    return make_error(
        "{}: fewer than 2 x 2 cells lie in --crop {}; the centres of its cells lie in "
        "{}",
        info.name, describe_box(*crop), describe_box(all));
  }
  return RasterWindow{static_cast<std::uint32_t>(west), static_cast<std::uint32_t>(north),
                      static_cast<std::uint32_t>(east - west) + 1,
                      static_cast<std::uint32_t>(south - north) + 1};
}

Status fits(const RasterInfo& info, const RasterWindow& window, std::uint32_t texels_per_cell) {
  const double cells = static_cast<double>(window.columns) * window.rows;
  const double bytes =
      cells * (kBytesPerCell + 3.0 * static_cast<double>(texels_per_cell) * texels_per_cell);
  if (bytes <= 0.5 * memory_of_machine()) return {};
  return make_error(
      "{}: its {} x {} cells take {:.1f} GB as patches, more than half of this machine's "
      "memory; convert a part of it with --crop",
      info.name, window.columns, window.rows, bytes / 1e9);
}

/// Reads rows with one more on each side. Heights outside of the crop become holes.
Result<RasterBand> read_band(HeightRaster& raster, const RasterPlan& plan,
                             const std::optional<Bounds>& crop, std::uint32_t row,
                             std::uint32_t rows) {
  const RasterWindow& all = plan.window;
  const std::uint32_t first = row > all.row ? row - 1 : row;
  const std::uint32_t end = std::min(row + rows + 1, all.row + all.rows);
  RasterBand band{all.columns, first, end - first, {}};
  band.heights.resize(std::size_t{band.columns} * band.rows);
  RELIEF_TRY(raster.read({all.column, first, all.columns, band.rows}, band.heights));
  if (!crop || !(std::isfinite(crop->min.z) || std::isfinite(crop->max.z))) return band;
  for (double& h : band.heights) {
    if (!(h >= crop->min.z && h <= crop->max.z)) h = NAN;
  }
  return band;
}

/// Reads all heights once, to find their step.
Result<HeightSteps> look(HeightRaster& raster, const RasterPlan& plan,
                         const std::optional<Bounds>& crop, Progress& progress) {
  progress.begin_stage("look", plan.window.rows);
  HeightSteps steps;
  for (std::uint32_t row = 0; row < plan.window.rows; row += kTileCells) {
    if (progress.cancelled()) return interrupted_error();
    const std::uint32_t rows = std::min(kTileCells, plan.window.rows - row);
    RELIEF_TRY_ASSIGN(const auto band, read_band(raster, plan, crop, plan.window.row + row, rows));
    steps.add(band.heights);
    progress.advance(rows);
  }
  return steps;
}

/// Chooses the step of heights, in the file's unit.
Status choose_step(HeightRaster& raster, const ConvertOptions& options,
                   const std::optional<Bounds>& crop, RasterPlan& plan, Progress& progress) {
  plan.step = plan.info.step;
  plan.offset = plan.info.offset;
  if (plan.step == 0.0) {
    RELIEF_TRY_ASSIGN(const auto found, look(raster, plan, crop, progress));
    if (found.empty()) return {};  // no patch will have a sample
    plan.step = found.decimal_step();
    // A power of two: its multiples are exact.
    if (plan.step == 0.0) {
      const double range = std::max(found.high() - found.low(), 1e-9);
      plan.step = std::exp2(std::ceil(std::log2(range / kStepsOfAll)));
    }
  }
  if (options.height_step > 0.0) plan.step = options.height_step / plan.height_unit;
  // The patch file allows a cell no more than 1e9 steps, nor a step more than 1e6 cells.
  plan.step = std::clamp(plan.step * plan.height_unit, plan.spacing * 1e-8, plan.spacing * 1e5) /
              plan.height_unit;
  return {};
}

std::uint32_t texels_for(const RasterPlan& plan, const Drape& drape, int asked) {
  if (asked > 0) return static_cast<std::uint32_t>(asked);
  const double finest =
      std::max(plan.info.grid.dx / drape.pixel.x, plan.info.grid.dy / drape.pixel.y);
  std::uint32_t texels = 1;
  while (texels < kMostTexelsPerCell && texels < finest * 0.9) texels *= 2;
  return texels;
}

void note_frame(const RasterInfo& info, const GeoFrame& frame, Progress& progress) {
  if (info.grid.in_degrees) {
    std::string text = fmt::format(
        "{}: is in degrees; x and y are metres from its centre, longitude {:.6f}, latitude {:.6f}",
        info.name, frame.centre.x, frame.centre.y);
    if (frame.stretch != 1.0)
      text += fmt::format("; x is {:.2f} % too {}, so that cells are square",
                          100.0 * std::abs(frame.stretch - 1.0),
                          frame.stretch > 1.0 ? "long" : "short");
    progress.note(text);
  }
  if (frame.cell.x != frame.cell.y) {
    progress.note(fmt::format(
        "{}: its cells are {:.6g} x {:.6g}; {} are interpolated, so that they "
        "become square",
        info.name, frame.cell.x, frame.cell.y, frame.cell.x < frame.cell.y ? "rows" : "columns"));
  }
}

/// The tiles of a row of tiles, from west to east.
std::vector<RasterWindow> tiles_of_row(const RasterWindow& window, std::uint32_t row,
                                       std::uint32_t rows) {
  std::vector<RasterWindow> tiles;
  for (std::uint32_t column = 0; column + 1 < window.columns; column += kTileCells) {
    const std::uint32_t columns = std::min(kTileCells + 1 + kOverlapCells, window.columns - column);
    tiles.push_back({window.column + column, row, columns, rows});
  }
  return tiles;
}

struct MadePatches {
  PatchModel model;
  RasterError error;
  std::uint64_t coarser = 0;
};

Result<MadePatches> make_patches(HeightRaster& raster, const RasterPlan& plan,
                                 const std::optional<Bounds>& crop, Progress& progress) {
  progress.begin_stage("patches", plan.window.rows);
  MadePatches made;
  for (std::uint32_t row = 0; row + 1 < plan.window.rows; row += kTileCells) {
    const std::uint32_t rows = std::min(kTileCells + 1 + kOverlapCells, plan.window.rows - row);
    const std::uint32_t first = plan.window.row + row;
    RELIEF_TRY_ASSIGN(const auto band, read_band(raster, plan, crop, first, rows));
    const auto tiles = tiles_of_row(plan.window, first, rows);
    std::vector<std::optional<Patch>> patches(tiles.size());
    std::vector<RasterError> errors(tiles.size());
    oneapi::tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t t) {
      if (!progress.cancelled()) patches[t] = make_raster_patch(plan, band, tiles[t], errors[t]);
    });
    if (progress.cancelled()) return interrupted_error();
    for (std::size_t t = 0; t < tiles.size(); ++t) {
      if (!patches[t]) continue;
      made.model.patches.push_back(std::move(*patches[t]));
      made.error.cells += errors[t].cells;
      made.error.sum_of_squares += errors[t].sum_of_squares;
      made.error.largest = std::max(made.error.largest, errors[t].largest);
      made.coarser += errors[t].is_coarser ? 1U : 0U;
    }
    progress.advance(std::min(kTileCells, rows));
  }
  return made;
}

void find_bounds(PatchModel& model) {
  for_each_position(std::span<const Patch>(model.patches),
                    [&](const glm::dvec3& p) { extend(model.bounds, p); });
  const glm::dvec3 centre = 0.5 * (model.bounds.min + model.bounds.max);
  double square = 0.0;
  for_each_position(std::span<const Patch>(model.patches), [&](const glm::dvec3& p) {
    square = std::max(square, glm::dot(p - centre, p - centre));
  });
  model.bounding_radius = std::sqrt(square);
}

ConvertReport report_of(const MadePatches& made, const RasterPlan& plan, std::uint64_t cells) {
  ConvertReport report;
  report.points = cells;
  report.normals_estimated = true;
  report.finest_spacing = report.coarsest_spacing = plan.spacing;
  report.error_rms = std::sqrt(made.error.sum_of_squares /
                               static_cast<double>(std::max<std::uint64_t>(made.error.cells, 1)));
  report.error_max = made.error.largest;
  report.psnr_db = 20.0 * std::log10(glm::length(made.model.bounds.max - made.model.bounds.min) /
                                     report.error_rms);
  if (plan.drape == nullptr) return report;
  report.texels_per_cell = plan.texels_per_cell;
  for (const Patch& patch : made.model.patches) report.colour_texels += patch.colours.texels.size();
  return report;
}

/// Fills in the cells, and returns the raster to read.
Result<std::unique_ptr<HeightRaster>> plan_cells(std::unique_ptr<HeightRaster> raster,
                                                 const ConvertOptions& options, RasterPlan& plan,
                                                 Progress& progress) {
  const RasterInfo& info = raster->info();
  plan.frame = frame_of(info.grid, info.columns, info.rows);
  if (options.spacing > 0.0) {
    if (info.has_coordinates) {
      return make_error("{}: has cells of its own size, {:.6g}; leave out --spacing", info.name,
                        plan.frame.cell.x);
    }
    plan.frame.factor = glm::dvec2(options.spacing);
    plan.frame.cell *= options.spacing;
  }
  note_frame(info, plan.frame, progress);
  // Sides that differ by rounding only are those of square cells.
  if (std::abs(plan.frame.cell.x / plan.frame.cell.y - 1.0) > 1e-9)
    raster = make_even(std::move(raster), plan.frame.cell);
  plan.info = raster->info();
  plan.spacing = std::min(plan.frame.cell.x, plan.frame.cell.y);
  plan.height_unit = plan.info.height_unit;
  return raster;
}

Result<ConvertResult> convert_opened(std::unique_ptr<HeightRaster> raster,
                                     const TextureChoice& texture, const ConvertOptions& options,
                                     const ReadOptions& read, Progress& progress) {
  const auto& crop = read.selection.crop;
  RasterPlan plan;
  RELIEF_TRY_ASSIGN(raster, plan_cells(std::move(raster), options, plan, progress));
  RELIEF_TRY_ASSIGN(plan.window, window_of(plan.info, crop));
  RELIEF_TRY(fits(plan.info, plan.window, 0));
  Drape drape;
  if (!texture.image.empty()) {
    const double most = options.texels_per_cell > 0 ? options.texels_per_cell : kMostTexelsPerCell;
    progress.begin_stage("photograph", 0);
    RELIEF_TRY_ASSIGN(drape, read_drape(texture.image, plan.info, plan.window, most));
    plan.drape = &drape;
    plan.texels_per_cell = texels_for(plan, drape, options.texels_per_cell);
    RELIEF_TRY(fits(plan.info, plan.window, plan.texels_per_cell));
    if (drape.covered < 0.999) {
      progress.note(
          fmt::format("{}: covers {:.0f} % of the heights; elsewhere they have the colours of "
                      "its edge",
                      texture.image.string(), 100.0 * drape.covered));
    }
  }
  RELIEF_TRY(choose_step(*raster, options, crop, plan, progress));
  RELIEF_TRY_ASSIGN(auto made, make_patches(*raster, plan, crop, progress));
  if (made.model.patches.empty()) {
    return make_error("{}: has no heights{}: all cells are without data", plan.info.name,
                      crop ? " in --crop" : "");
  }
  if (made.coarser > 0) {
    progress.note(
        fmt::format("{}: heights of {} patches span more than {} steps of {:g} and are rounded",
                    plan.info.name, made.coarser, kMaxHeightRange, plan.step));
  }
  made.model.spacing = plan.spacing;
  made.model.has_colours = plan.drape != nullptr;
  made.model.stance = stance_of(options.up, kZUp);
  find_bounds(made.model);
  ConvertReport report = report_of(made, plan, made.error.cells);
  return ConvertResult{std::move(made.model), report};
}

/// Returns the options that do not apply to rasters and are set, as the command line names them
/// ("--error, --seams"); empty if there is none.
std::string unused_for_rasters(const ConvertOptions& options, const ReadOptions& read) {
  std::string names;
  const auto name_if = [&](bool is_set, std::string_view name) {
    if (is_set) names += fmt::format("{}{}", names.empty() ? "" : ", ", name);
  };
  name_if(options.samples > 0, "--samples");
  name_if(options.error > 0.0, "--error");
  name_if(options.adaptive_spacing.value_or(false), "--adaptive-spacing");
  name_if(!options.adaptive_spacing.value_or(true), "--even-spacing");
  name_if(options.cone_degrees > 0.0, "--cone-degrees");
  name_if(options.seams.value_or(false), "--seams");
  name_if(options.seams.has_value() && !*options.seams, "--overlap");
  name_if(options.noise_removal != NoiseRemoval::Default, "--noise");
  name_if(read.selection.asks_for_classes(), describe_classes(read.selection));
  return names;
}

}  // namespace

Result<ConvertResult> convert_raster(const std::filesystem::path& path,
                                     const TextureChoice& texture, const ConvertOptions& options,
                                     const ReadOptions& read, Progress& progress) {
  const std::string name = path.string();
  if (const std::string unused = unused_for_rasters(options, read); !unused.empty())
    return make_error("{}: is a raster, whose cells become samples as they are; leave out {}", name,
                      unused);
  return guarded({.subject = name,
                  .task = "convert it",
                  .library = "GDAL",
                  .advice = "the file may be damaged: write it again with gdal_translate",
                  .memory_advice = "convert a part of it with --crop"},
                 [&]() -> Result<ConvertResult> {
                   RELIEF_TRY_ASSIGN(auto raster, open_raster(path, read.format, progress));
                   return with_threads(options.threads, [&] {
                     return convert_opened(std::move(raster), texture, options, read, progress);
                   });
                 });
}

}  // namespace relief
