#include "tests/experiments/ray_layers.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "common/progress.h"
#include "renderer/engines/raytrace/embree_scene.h"
#include "renderer/view/view.h"

namespace relief::experiment {

Result<std::vector<RayLayers>> find_layers(const TriangleMesh& mesh, const Camera& camera,
                                           std::uint32_t side) {
  const Progress progress;
  const auto scene = raytrace::EmbreeScene::build(mesh, camera.eye, progress);
  if (!scene) return scene.error();
  const View view = make_view(camera, side, side, 1.0);
  std::vector<RayLayers> layers(std::size_t{side} * side);
  tbb::parallel_for(std::uint32_t{0}, side, [&](std::uint32_t y) {
    std::vector<raytrace::Hit> hits;
    for (std::uint32_t x = 0; x < side; ++x) {
      scene->find_all({{}, ray_through(view, {x + 0.5, side - 1 - y + 0.5})}, hits);
      std::ranges::sort(hits, {}, &raytrace::Hit::depth);
      RayLayers& pixel = layers[std::size_t{y} * side + x];
      pixel.least_gap = std::numeric_limits<double>::infinity();
      double before = 0.0;
      for (const raytrace::Hit& hit : hits) {
        const double gap = hit.depth - before;
        if (pixel.surfaces > 0 && gap <= 1e-12 * hit.depth) continue;  // rounding
        if (pixel.surfaces > 0) pixel.least_gap = std::min(pixel.least_gap, gap);
        before = hit.depth;
        ++pixel.surfaces;
      }
    }
  });
  return layers;
}

}  // namespace relief::experiment
