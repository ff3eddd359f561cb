#include "renderer/engines/volume/shader_splats.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "renderer/engines/volume/rule.h"

namespace relief::volume {
namespace {

glm::vec3 bounded(glm::vec3 colour) {
  return glm::min(colour, glm::vec3(kLargest));
}

}  // namespace

std::vector<shared::VolumeSplat> shader_splats(const VolumeFrame& frame,
                                               std::span<const PlacedSplat> placed) {
  std::vector<shared::VolumeSplat> splats(placed.size());
  tbb::parallel_for(std::size_t{0}, placed.size(), [&](std::size_t s) {
    const Footprint& f = placed[s].footprint;
    const std::uint32_t k = placed[s].kernel;
    shared::VolumeSplat& splat = splats[s];
    splat.place = {f.centre.x, f.centre.y, f.cutoff, std::min(f.peak, double{kLargest})};
    splat.shape = {f.xx, f.xy, f.yy, f.depth};
    splat.colour = glm::vec4(bounded(frame.colours[k]), f.depth_deviation);
    splat.normal =
        frame.cloud.normals.empty() ? glm::vec4(0.0F) : glm::vec4(frame.cloud.normals[k], 0.0F);
    splat.slope = {f.slope.x, f.slope.y, 0.0, 0.0};
  });
  return splats;
}

Result<Table> make_splat_table(const Gl& gl, std::span<const shared::VolumeSplat> splats) {
  const std::size_t texels = splats.size() * shared::kVolumeSplatRows;
  if (texels > static_cast<std::size_t>(get_limit(gl, GL_MAX_TEXTURE_BUFFER_SIZE))) {
    return make_error(
        "{} kernels are more than this OpenGL can draw at once; --engine volume-reference can",
        splats.size());
  }
  return make_table<glm::vec4>(gl, "splats", GL_RGBA32F,
                               {reinterpret_cast<const glm::vec4*>(splats.data()), texels});
}

}  // namespace relief::volume
