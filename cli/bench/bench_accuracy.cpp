#include "cli/bench/bench_accuracy.h"

#include <utility>

#include "common/compare/compare.h"
#include "renderer/render.h"

namespace relief::cli {
namespace {

constexpr int kMirrorSamples = 16;

/// The settings of an image that is compared.
RenderSettings compared(const RenderSettings& row, const Look& look) {
  RenderSettings settings = row;
  settings.material = look.material;
  settings.outputs = look.outputs;
  settings.frames = 0;
  return settings;
}

RenderSettings truth_of(const RenderSettings& row, const Look& look) {
  RenderSettings settings = compared(row, look);
  settings.engine = "raytrace";
  settings.raytrace.samples = look.rays;
  return settings;
}

std::optional<double> value_of(const Result<double>& measured) {
  return measured ? std::optional<double>(*measured) : std::nullopt;
}

/// The rows from `first` on that draw the same model.
std::vector<RenderSettings> rows_of_model(const std::vector<BenchMethod>& rows, std::size_t first,
                                          const Look& look) {
  std::vector<RenderSettings> images;
  for (std::size_t k = first; k < rows.size() && rows[k].model == rows[first].model; ++k)
    images.push_back(compared(rows[k].settings, look));
  return images;
}

/// The rows and the truth in one look.
Result<std::vector<Comparison>> compare_in(const Look& look, const std::vector<BenchMethod>& rows,
                                           const TriangleMesh* mesh, Progress& progress) {
  RELIEF_TRY_ASSIGN(const auto truth, trace_truth(rows.front(), mesh, look, progress));
  return compare_rows(rows, truth, look, progress);
}

}  // namespace

Look look_in(Material material, CompareNormals normals, int rays) {
  return {material, {.normal = normals == CompareNormals::Yes, .depth = true}, rays};
}

Result<Image> trace_truth(const BenchMethod& row, const TriangleMesh* mesh, const Look& look,
                          Progress& progress) {
  const RenderSettings traced = truth_of(row.settings, look);
  Image truth;
  RenderModel model = row.model;
  if (mesh != nullptr) model.add(*mesh);
  const Status done = render_views(
      model, {&traced, 1},
      [&truth](std::size_t /*view*/, RenderResult image) {
        truth = std::move(image.image);
        return Status();
      },
      progress);
  if (!done) return done.error();
  return truth;
}

Result<std::vector<Comparison>> compare_rows(const std::vector<BenchMethod>& rows,
                                             const Image& truth, const Look& look,
                                             Progress& progress) {
  std::vector<std::optional<Comparison>> found(rows.size());
  const FlipOptions options{FlipRange::Ldr, kFlipPixelsPerDegree};
  Progress silent;
  for (std::size_t first = 0; first < rows.size();) {
    const std::vector<RenderSettings> images = rows_of_model(rows, first, look);
    const Status drawn = render_views(
        rows[first].model, images,
        [&](std::size_t row, RenderResult image) -> Status {
          RELIEF_TRY_ASSIGN(auto comparison, compare_images(image.image, truth, options, silent));
          comparison.flip.map = {};  // as large as the image
          found[first + row] = std::move(comparison);
          return {};
        },
        progress);
    if (!drawn) return drawn.error();
    first += images.size();
  }
  std::vector<Comparison> all;
  all.reserve(found.size());
  for (auto& comparison : found) all.push_back(std::move(*comparison));
  return all;
}

PictureAccuracy accuracy_of(const Comparison& comparison) {
  PictureAccuracy accuracy;
  accuracy.psnr_db = comparison.psnr_db;
  accuracy.flip_mean = comparison.flip.mean;
  if (comparison.coverage) {
    accuracy.holes = comparison.coverage->holes;
    accuracy.border_missing = comparison.coverage->border_missing;
    accuracy.border_extra = comparison.coverage->border_extra;
  }
  if (comparison.normal) accuracy.normal_rms_deg = comparison.normal->rms_deg;
  return accuracy;
}

Result<std::vector<RowAccuracy>> measure_accuracy(const std::vector<BenchMethod>& rows,
                                                  const TriangleMesh* mesh, CompareNormals normals,
                                                  Progress& progress) {
  const Material material = rows.front().settings.material;
  const Look seen_look =
      look_in(material, normals, material == Material::Mirror ? kMirrorSamples : 1);
  RELIEF_TRY_ASSIGN(const auto seen, compare_in(seen_look, rows, mesh, progress));
  const Look mirrored = look_in(Material::Mirror, CompareNormals::No, kMirrorSamples);
  RELIEF_TRY_ASSIGN(const auto mirrors, material == Material::Mirror
                                            ? seen
                                            : compare_in(mirrored, rows, mesh, progress));
  std::vector<RowAccuracy> all;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const Comparison& own = seen[row];
    const Comparison& mirror = mirrors[row];
    RowAccuracy accuracy{accuracy_of(own), {}, {}, {}};
    accuracy.psnr_covered_db = value_of(own.psnr_covered_db);
    accuracy.psnr_mirror_db = mirror.psnr_db;
    accuracy.psnr_mirror_covered_db = value_of(mirror.psnr_covered_db);
    all.push_back(accuracy);
  }
  return all;
}

}  // namespace relief::cli
