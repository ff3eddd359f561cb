#include "preprocess/tiles/tile_conversion.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "common/median.h"
#include "preprocess/convert_stages.h"
#include "preprocess/frame/working_frame.h"
#include "preprocess/frame/working_unit.h"
#include "preprocess/normals/orient_sample.h"
#include "preprocess/tiles/checkpoint.h"
#include "preprocess/tiles/clean_tile.h"
#include "preprocess/tiles/join_sheets.h"
#include "preprocess/tiles/resample_tile.h"
#include "preprocess/tiles/survey.h"
#include "preprocess/tiles/tile_files.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

class TileConversion {
 public:
  TileConversion(const TileTask& task, Progress& progress)
      : name_(task.name),
        folder_(task.folder),
        scan_(task.scan),
        options_(to_working_unit(task.options, scan_.unit)),
        file_options_(task.file_options),
        is_clean_(task.is_clean),
        progress_(progress),
        centre_(to_working_frame(scan_.frame,
                                 (scan_.bounds.min + scan_.bounds.max) / 2.0 / scan_.unit)) {
    options_.side = to_working_frame(scan_.frame, options_.side);
  }

  Result<ConvertedTiles> run() {
    if (const Status good = check_spacing(options_.spacing * scan_.unit, scan_.bounds); !good)
      return make_error("{}: {}", name_, good.error().message);
    for (const auto step :
         {&TileConversion::clean, &TileConversion::survey, &TileConversion::orient,
          &TileConversion::choose_grid, &TileConversion::resample, &TileConversion::sum_up}) {
      RELIEF_TRY((this->*step)());
    }
    return ConvertedTiles{std::move(result_), extent(), patches_};
  }

 private:
  [[nodiscard]] std::uint32_t tile_count() const {
    return static_cast<std::uint32_t>(scan_.counts.size());
  }
  [[nodiscard]] bool is_resampled(std::uint32_t tile) const {
    return fs::exists(folder_.part(tile));
  }

  Result<TilePoints> load(std::uint32_t tile) const {
    auto loaded = load_tile(folder_.folder(), tile, scan_.counts[tile], scan_.attributes);
    if (!loaded) return loaded;
    loaded->points.viewpoint = scan_.viewpoint;
    loaded->points.is_airborne = scan_.is_airborne;
    return loaded;
  }

  /// Loads a tile without noise and stray points.
  Result<TilePoints> load_clean(std::uint32_t tile) const {
    RELIEF_TRY_ASSIGN(auto loaded, load(tile));
    if (is_clean_) return loaded;
    RELIEF_TRY(take_clean_points(
        loaded, tile, [this](std::uint32_t home) { return load_clean_tile(folder_.clean(home)); }));
    return loaded;
  }

  Status clean() {
    if (is_clean_ || fs::exists(folder_.turns())) return {};
    progress_.begin_stage("clean", scan_.read.points);
    for (std::uint32_t tile = 0; tile < tile_count(); ++tile) {
      if (!fs::exists(folder_.clean(tile))) {
        RELIEF_TRY_ASSIGN(auto loaded, load(tile));
        QuietProgress quiet(progress_);
        const CleanTile found = clean_tile(std::move(loaded), options_, quiet);
        if (progress_.cancelled()) return interrupted_error();
        RELIEF_TRY(save_clean_tile(folder_.clean(tile), found));
      }
      progress_.advance(scan_.counts[tile].own);
    }
    return {};
  }

  /// Whether a known direction decides the sides.
  [[nodiscard]] bool sides_are_sure() const {
    Points known;
    known.viewpoint = scan_.viewpoint;
    return known_sides(known, options_.side).is_sure;
  }

  /// Whether tiles can't know which side their surface faces.
  [[nodiscard]] bool needs_whole() const {
    return !scan_.attributes.normals && !scan_.is_airborne &&
           scan_.sample.size() >= kMinSurfacePoints && !sides_are_sure();
  }

  Status survey() {
    progress_.begin_stage("survey", scan_.read.points);
    if (needs_whole() && !fs::exists(folder_.turns())) {
      whole_ = orient_sample(scan_.sample, options_.side, progress_);
      if (progress_.cancelled()) return interrupted_error();
      options_.side.whole = &*whole_;
    }
    for (std::uint32_t tile = 0; tile < tile_count(); ++tile) {
      if (!fs::exists(folder_.survey(tile)) && !fs::exists(folder_.turns())) {
        RELIEF_TRY(survey_one(tile));
      }
      progress_.advance(scan_.counts[tile].own);
    }
    return {};
  }

  Status survey_one(std::uint32_t tile) {
    RELIEF_TRY_ASSIGN(auto loaded, load_clean(tile));
    QuietProgress quiet(progress_);
    const SurveyOptions survey_options{.cone_degrees = options_.cone_degrees,
                                       .side = options_.side,
                                       .seams = seams_,
                                       .find_area = options_.spacing == 0.0,
                                       .centre = centre_};
    const TileSurvey made = survey_tile(loaded, survey_options, quiet);
    if (progress_.cancelled()) return interrupted_error();
    const std::vector<RimPoint> rim = rim_of(loaded, made);
    // The survey's file, written last, proves that all three exist.
    RELIEF_TRY(save_checkpoint(folder_.rim(tile), std::tie(rim)));
    RELIEF_TRY(save_checkpoint(folder_.cosines(tile), std::tie(made.cosines)));
    return save_survey(folder_.survey(tile), made);
  }

  /// Contents of the file of turns.
  auto orientation() {
    return std::tie(area_, radius_, repaired_, duplicates_, noise_, moved_, strays_, turns_);
  }

  /// The sheets to flip, and other results that need the surveys of all tiles.
  Status orient() {
    progress_.begin_stage("orient", 0);
    if (!fs::exists(folder_.turns())) return orient_all();
    RELIEF_TRY(load_checkpoint(folder_.turns(), orientation()));
    return turns_.size() == tile_count() ? Status{} : wrong_checkpoint(folder_.turns());
  }

  Status orient_all() {
    std::vector<SurveyPaths> paths;
    for (std::uint32_t tile = 0; tile < tile_count(); ++tile)
      paths.push_back({folder_.survey(tile), folder_.rim(tile)});
    RELIEF_TRY_ASSIGN(auto turns, join_sheets(paths, needs_whole() || sides_are_sure(), progress_));
    turns_ = std::move(turns);
    for (std::uint32_t tile = 0; tile < tile_count(); ++tile) {
      RELIEF_TRY_ASSIGN(const auto survey, load_survey(folder_.survey(tile)));
      area_ += survey.area;
      radius_ = std::max(radius_, survey.radius);
      repaired_ += survey.normals_repaired;
      duplicates_ += scan_.counts[tile].own - survey.region.size();
    }
    RELIEF_TRY(sum_up_cleaning());
    duplicates_ -= strays_;
    return save_checkpoint(folder_.turns(), orientation());
  }

  /// The scan's noise is the median of that of tiles, which have about as many points.
  Status sum_up_cleaning() {
    std::vector<double> of_tiles;
    for (std::uint32_t tile = 0; !is_clean_ && tile < tile_count(); ++tile) {
      RELIEF_TRY_ASSIGN(const auto found, load_clean_tile(folder_.clean(tile)));
      of_tiles.push_back(found.noise);
      moved_ += found.moved;
      strays_ += found.strays;
    }
    if (!of_tiles.empty()) noise_ = median_of(of_tiles);
    return {};
  }

  Status choose_grid() {
    const std::uint64_t points = scan_.read.points - duplicates_ - strays_;
    spacing_ =
        options_.spacing > 0.0 ? options_.spacing : std::sqrt(area_ / static_cast<double>(points));
    if (!(spacing_ > 0.0))
      return make_error("{}: the points are too scattered to be a surface", name_);
    if (area_ == 0.0) return {};
    const Status checked =
        check_spacing(spacing_ * scan_.unit, area_ * scan_.unit * scan_.unit, points);
    return checked ? checked : make_error("{}: {}", name_, checked.error().message);
  }

  Status resample() {
    progress_.begin_stage("resample", scan_.read.points);
    for (std::uint32_t tile = 0; tile < tile_count(); ++tile) {
      if (is_resampled(tile)) {
        ++result_.tiles_found;
      } else if (Status done = resample_one(tile); !done) {
        return done;
      }
      remove_tile(folder_.folder(), tile);
      progress_.advance(scan_.counts[tile].own);
    }
    return {};
  }

  Status resample_one(std::uint32_t tile) {
    RELIEF_TRY_ASSIGN(auto loaded, load_clean(tile));
    merge_duplicates(loaded);
    RELIEF_TRY_ASSIGN(auto survey, load_survey(folder_.survey(tile)));
    const auto cosines = halo_cosines(loaded, [&](std::uint32_t home) {
      std::vector<float> of_home;
      const Status read = load_checkpoint(folder_.cosines(home), std::tie(of_home));
      return read ? Result(std::move(of_home)) : read.error();
    });
    if (!cosines) return cosines.error();
    QuietProgress quiet(progress_);
    ResampleOptions resampling = resample_options(
        options_, seams_, spacing_,
        source_of_normals(scan_.attributes.normals, !loaded.smooth_normals.empty()));
    // Where patches that meet reach a tile's border, one cell of margin left pinholes.
    if (resampling.seams) resampling.overlap_cells = 2;
    TilePatches made = resample_tile({.points = std::move(loaded),
                                      .scalars = scan_.attributes.scalars,
                                      .survey = std::move(survey),
                                      .turns = turns_[tile],
                                      .halo_cosines = *cosines},
                                     resampling, quiet);
    if (progress_.cancelled()) return interrupted_error();
    RELIEF_TRY(save_report(folder_.part_report(tile), made));
    PatchModel model = extent();
    model.patches = std::move(made.patches);
    to_world_frame(scan_.frame, model.patches);
    to_world_unit(model.patches, scan_.unit);
    if (seams_) model.joined = {{0, static_cast<std::uint32_t>(model.patches.size())}};
    return write_patch_file(folder_.part(tile), model, file_options_);
  }

  [[nodiscard]] PatchModel extent() const {
    PatchModel model;
    model.spacing = spacing_ * scan_.unit;
    model.bounds = scan_.bounds;
    model.bounding_radius = radius_ * scan_.unit;
    model.stance = stance_of(options_.up, scan_.stance);
    model.has_colours = scan_.attributes.colours;
    model.scalars = scan_.attributes.scalars;
    return model;
  }

  Status sum_up() {
    TilePatches all;  // its sums
    ConvertReport& report = result_.report;
    for (std::uint32_t tile = 0; tile < tile_count(); ++tile) {
      RELIEF_TRY_ASSIGN(const auto one, load_report(folder_.part_report(tile)));
      all.patch_count += one.patch_count;
      all.points += one.points;
      all.sum_of_squares += one.sum_of_squares;
      report.error_max = std::max(report.error_max, one.error_max * scan_.unit);
      report.uncovered_points += one.uncovered;
      report.colour_texels += one.texels.colour_texels;
      report.texels_per_cell = std::max(report.texels_per_cell, one.texels.texels_per_cell);
      report.normal_texels += one.texels.normal_texels;
      report.normal_texels_per_cell =
          std::max(report.normal_texels_per_cell, one.texels.normal_texels_per_cell);
      result_.halo_points += scan_.counts[tile].halo;
    }
    patches_ = all.patch_count;
    report.points = all.points;
    report.normals_repaired = repaired_;
    report.normals_estimated = !scan_.attributes.normals;
    report.noise = noise_ * scan_.unit;
    report.points_moved = moved_;
    report.stray_points = strays_;
    report.error_rms = std::sqrt(all.sum_of_squares / static_cast<double>(all.points)) * scan_.unit;
    report.psnr_db =
        20.0 * std::log10(glm::distance(scan_.bounds.min, scan_.bounds.max) / report.error_rms);
    result_.nonfinite = scan_.read.nonfinite;
    result_.left_out = scan_.read.left_out;
    result_.not_selected = scan_.read.not_selected;
    result_.duplicates = duplicates_;
    result_.tiles = tile_count();
    result_.notes = scan_.notes;
    return {};
  }

  const std::string& name_;
  const TileFolder& folder_;
  const SpreadScan& scan_;
  ConvertOptions options_;  // in the tiles' unit and frame, as all that follows
  bool seams_ = options_.seams.value_or(false);
  const PatchFileOptions& file_options_;
  bool is_clean_;
  Progress& progress_;
  glm::dvec3 centre_;

  std::optional<SampledSides> whole_;
  SheetTurns turns_;
  double area_ = 0.0;    // of all regions; 0 if the spacing is given
  double radius_ = 0.0;  // of all points about the centre
  std::uint64_t repaired_ = 0;
  std::uint64_t duplicates_ = 0;
  double noise_ = 0.0;
  std::uint64_t moved_ = 0;
  std::uint64_t strays_ = 0;
  double spacing_ = 0.0;
  TiledResult result_;
  std::uint64_t patches_ = 0;
};

}  // namespace

Result<ConvertedTiles> convert_spread(const TileTask& task, Progress& progress) {
  return TileConversion(task, progress).run();
}

}  // namespace relief
