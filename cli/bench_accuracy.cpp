#include "cli/bench_accuracy.h"

#include <algorithm>
#include <utility>

#include "common/compare/compare.h"

namespace relief::cli {
namespace {

constexpr int kMirrorSamples = 16;

/// What coverage is found by, also where the model fills the picture (common/compare/coverage.h).
constexpr Outputs kOutputs{.depth = true};

/// The settings of a picture that is compared.
RenderSettings compared(const RenderSettings& row, Material material) {
  RenderSettings settings = row;
  settings.material = material;
  settings.outputs = kOutputs;
  settings.frames = 1;
  return settings;
}

RenderSettings truth_of(const RenderSettings& row, Material material) {
  RenderSettings settings = compared(row, material);
  settings.engine = EngineKind::Raytrace;
  settings.raytrace.samples = material == Material::Mirror ? kMirrorSamples : 1;
  return settings;
}

std::optional<double> value_of(const Result<double>& measured) {
  return measured ? std::optional<double>(*measured) : std::nullopt;
}

/// The rows in one material.
Result<std::vector<Comparison>> compare_in(Material material, const RenderModel& model,
                                           const std::vector<RenderSettings>& rows,
                                           Progress& progress) {
  Image truth;
  const RenderSettings traced = truth_of(rows.front(), material);
  const Status done = render_views(
      model, {&traced, 1},
      [&truth](std::size_t /*view*/, RenderResult picture) {
        truth = std::move(picture.image);
        return Status();
      },
      progress);
  if (!done) return done.error();

  std::vector<RenderSettings> pictures;
  std::transform(rows.begin(), rows.end(), std::back_inserter(pictures),
                 [material](const RenderSettings& row) { return compared(row, material); });
  std::vector<std::optional<Comparison>> found(rows.size());
  const FlipOptions options{FlipRange::Ldr, kFlipPixelsPerDegree};
  Progress silent;
  const Status drawn = render_views(
      model, pictures,
      [&](std::size_t row, RenderResult picture) -> Status {
        auto comparison = compare_images(picture.image, truth, options, silent);
        if (!comparison) return comparison.error();
        found[row] = std::move(*comparison);
        found[row]->flip.map = {};  // as large as the picture
        return {};
      },
      progress);
  if (!drawn) return drawn.error();
  std::vector<Comparison> all;
  all.reserve(found.size());
  for (auto& comparison : found) all.push_back(std::move(*comparison));
  return all;
}

}  // namespace

Result<std::vector<RowAccuracy>> measure_accuracy(const RenderModel& model,
                                                  const std::vector<RenderSettings>& rows,
                                                  Progress& progress) {
  const Material material = rows.front().material;
  const auto seen = compare_in(material, model, rows, progress);
  if (!seen) return seen.error();
  auto mirrors =
      material == Material::Mirror ? seen : compare_in(Material::Mirror, model, rows, progress);
  if (!mirrors) return mirrors.error();
  std::vector<RowAccuracy> all;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const Comparison& own = (*seen)[row];
    const Comparison& mirror = (*mirrors)[row];
    RowAccuracy accuracy;
    accuracy.psnr_db = own.psnr_db;
    accuracy.psnr_covered_db = value_of(own.psnr_covered_db);
    accuracy.psnr_mirror_db = mirror.psnr_db;
    accuracy.psnr_mirror_covered_db = value_of(mirror.psnr_covered_db);
    accuracy.flip_mean = own.flip.mean;
    if (own.coverage) accuracy.holes = own.coverage->holes;
    all.push_back(accuracy);
  }
  return all;
}

}  // namespace relief::cli
