#include "renderer/engines/raytrace/render_raytrace.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <optional>
#include <utility>
#include <vector>

#include "common/median.h"
#include "common/transform.h"
#include "renderer/engines/raytrace/embree_scene.h"
#include "renderer/engines/raytrace/sampling.h"
#include "renderer/engines/raytrace/tracer.h"
#include "renderer/frame/targets/film.h"
#include "renderer/geometry/meshes/mesh_of_patches.h"
#include "renderer/owned_or_borrowed.h"
#include "renderer/shading/environment/environment_cache.h"
#include "renderer/shading/materials.h"

namespace relief::raytrace {
namespace {

/// Pixels along a tile's side: small enough to share out evenly, large enough for rays that meet
/// the same triangles.
constexpr std::uint32_t kTile = 16;

/// The near plane of what does not need one: rays start at the eye, or in the plane through it.
constexpr double kAnyNear = 1.0;

bool has_geometry(const Outputs& outputs) {
  return outputs.normal || outputs.depth || outputs.uv || outputs.patch_id;
}

/// `corner` is the pixel's lower left one, in the window.
FilmPixel trace_pixel(const Tracer& tracer, glm::dvec2 corner,
                      const std::vector<glm::dvec2>& pattern, bool geometry) {
  FilmPixel pixel;
  std::optional<Hit> middle;
  glm::dvec4 sum(0.0);
  for (const glm::dvec2& offset : pattern) {
    const Seen seen = tracer.look_through(corner + offset);
    sum += glm::dvec4(seen.colour);
    middle = seen.nearest;
  }
  pixel.colour = glm::vec4(sum / static_cast<double>(pattern.size()));
  if (!geometry) return pixel;
  if (pattern.size() > 1) middle = tracer.find_through(corner + 0.5);
  if (middle) tracer.describe(*middle, pixel);
  return pixel;
}

void trace_frame(const Tracer& tracer, const std::vector<glm::dvec2>& pattern, bool geometry,
                 Film& film, Progress& progress) {
  const std::uint32_t columns = (film.width + kTile - 1) / kTile;
  const std::uint32_t rows = (film.height + kTile - 1) / kTile;
  tbb::parallel_for(std::uint32_t{0}, columns * rows, [&](std::uint32_t tile) {
    if (progress.cancelled()) return;
    const std::uint32_t left = tile % columns * kTile;
    const std::uint32_t top = tile / columns * kTile;
    for (std::uint32_t y = top; y < std::min(top + kTile, film.height); ++y) {
      for (std::uint32_t x = left; x < std::min(left + kTile, film.width); ++x) {
        film.pixels[std::size_t{y} * film.width + x] =
            trace_pixel(tracer, {x, film.height - 1 - y}, pattern, geometry);
      }
    }
    progress.advance(1);
  });
}

/// One image; `environments` has those of earlier ones.
Result<RenderResult> trace_image(const TriangleMesh& mesh, EnvironmentCache& environments,
                                 const RenderSettings& settings, Progress& progress) {
  assert(mesh.normals.size() == mesh.positions.size() && "a mesh has normals");
  const View view = make_view(settings.camera, settings.width, settings.height, kAnyNear);
  RELIEF_TRY_ASSIGN(const auto surroundings, surroundings_of(settings, environments));
  RELIEF_TRY_ASSIGN(auto lighting, make_lighting(settings, view, environments));
  progress.begin_stage("sort triangles", 0);
  const bool anywhere = view.orthographic || has_two_interfaces(settings);
  RELIEF_TRY_ASSIGN(const auto scene,
                    EmbreeScene::build(mesh, settings.camera.eye, progress,
                                       anywhere ? RayStarts::Anywhere : RayStarts::AtEye));
  const Tracer tracer(mesh, scene, view, std::move(lighting));
  const std::vector<glm::dvec2> pattern = sample_pattern(settings.raytrace.samples);

  Film film{settings.width, settings.height,
            std::vector<FilmPixel>(std::size_t{settings.width} * settings.height)};
  const int frames = std::max(settings.frames, 1);
  const std::uint64_t tiles =
      std::uint64_t{(film.width + kTile - 1) / kTile} * ((film.height + kTile - 1) / kTile);
  progress.begin_stage("trace rays", tiles * static_cast<std::uint64_t>(frames));
  std::vector<double> frame_ms;
  for (int i = 0; i < frames; ++i) {
    const auto start = std::chrono::steady_clock::now();
    trace_frame(tracer, pattern, has_geometry(settings.outputs), film, progress);
    const std::chrono::duration<double, std::milli> elapsed =
        std::chrono::steady_clock::now() - start;
    frame_ms.push_back(elapsed.count());
    if (progress.cancelled()) return interrupted_error();
  }

  RenderResult result;
  result.renderer = scene.name();
  result.frame_ms = median_of(std::move(frame_ms));
  result.image = develop(film, surroundings, view, settings.outputs, result.covered_pixels);
  return result;
}

/// The triangles of patches, those of each instance in their positions.
Result<TriangleMesh> triangulate(const PatchModel& patches) {
  if (patches.instances.empty()) return mesh_of_patches(patches);
  auto mesh = mesh_of_patches(bake(patches));
  if (mesh) mesh->bodies = bodies_of(patches, *mesh);
  return mesh;
}

class Prepared final : public PreparedModel {
 public:
  template <class Mesh>
  Prepared(Mesh&& mesh, std::shared_ptr<EnvironmentCache> environments)
      : mesh_(std::forward<Mesh>(mesh)), environments_(std::move(environments)) {}

  Result<RenderResult> render(const RenderSettings& settings, Progress& progress) override {
    return trace_image(*mesh_, *environments_, settings, progress);
  }

 private:
  OwnedOrBorrowed<TriangleMesh> mesh_;
  std::shared_ptr<EnvironmentCache> environments_;
};

}  // namespace

Result<std::unique_ptr<PreparedModel>> prepare(const PrepareRequest& request) {
  if (const auto* const mesh = request.model.find<TriangleMesh>())
    return std::unique_ptr<PreparedModel>(std::make_unique<Prepared>(*mesh, request.environments));
  const auto* const patches = request.model.find<PatchModel>();
  assert(patches != nullptr && "there is a mesh, or patches");
  RELIEF_TRY_ASSIGN(auto mesh, triangulate(*patches));
  return std::unique_ptr<PreparedModel>(
      std::make_unique<Prepared>(std::move(mesh), request.environments));
}

}  // namespace relief::raytrace
