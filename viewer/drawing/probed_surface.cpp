#include "viewer/drawing/probed_surface.h"

#include <cmath>

#include "renderer/view/view.h"

namespace relief {

std::optional<ProbedSurface> surface_of(const Image& pixel, const Session& session,
                                        glm::dvec2 cursor) {
  const Channel* const depth = pixel.find("Z");
  if (depth == nullptr || !std::isfinite(depth->values.front())) return std::nullopt;
  const View view =
      make_view(session.navigator.camera(), static_cast<std::uint32_t>(session.window.x),
                static_cast<std::uint32_t>(session.window.y), 0.0);
  const glm::dvec2 middle(std::floor(cursor.x) + 0.5,
                          session.window.y - std::floor(cursor.y) - 0.5);
  ProbedSurface surface;
  surface.start = view.eye + ray_start(view, middle);
  surface.direction = ray_through(view, middle);
  surface.depth = depth->values.front();
  surface.pixel = pixel_at(view, surface.depth);
  return surface;
}

}  // namespace relief
