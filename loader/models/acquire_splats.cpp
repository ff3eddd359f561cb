#include "loader/models/acquire_splats.h"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "common/image/image_io.h"
#include "preprocess/readers/read_points.h"
#include "preprocess/texture/acquisition/acquire_texture.h"

namespace relief {
namespace {

std::string describe(const AcquireResult& acquired) {
  const AcquireReport& report = acquired.report;
  std::string text =
      fmt::format("texture: {} splats of {:.3g} texels each, rms error {:.4f} in linear light",
                  acquired.splats.positions.size(), report.texels_per_point, report.rms_error);
  if (report.fit) {
    text += fmt::format("; residual {:.1e} after {} steps", report.fit->residual,
                        report.fit->iterations);
    if (report.fit->condition) text += fmt::format(", condition {:.3g}", *report.fit->condition);
  }
  return text;
}

}  // namespace

Result<SplatCloud> acquire_splats(const std::filesystem::path& mesh, const TextureChoice& choice,
                                  const AcquireOptions& options, Progress& progress) {
  const std::filesystem::path& file = choice.image;
  RELIEF_TRY_ASSIGN(const auto texture, read_image(file));
  RELIEF_TRY_ASSIGN(auto scan, read_points(mesh, progress));
  if (choice.flips_v) flip_v(scan.points);
  auto acquired = acquire_texture(std::move(scan.points), texture, options, progress);
  if (!acquired) {
    return make_error("{} with {}: {}", mesh.string(), file.string(), acquired.error().message);
  }
  progress.note(describe(*acquired));
  SplatCloud cloud;
  cloud.radii.assign(acquired->splats.positions.size(), acquired->splats.deviation);
  cloud.colours.reserve(acquired->splats.colours.size());
  for (const glm::vec3 colour : acquired->splats.colours) cloud.colours.emplace_back(colour, 1.0F);
  cloud.positions = std::move(acquired->splats.positions);
  cloud.normals = std::move(acquired->splats.normals);
  return cloud;
}

}  // namespace relief
