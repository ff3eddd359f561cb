#include "renderer/render.h"

#include "renderer/engines/onepass/render_onepass.h"

namespace relief {

Result<RenderResult> render(const PatchModel& model, const RenderSettings& settings,
                            Progress& /*progress*/) {
  return onepass::render(model, settings);
}

}  // namespace relief
