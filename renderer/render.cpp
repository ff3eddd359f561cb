#include "renderer/render.h"

#include "renderer/engines/ewa/render_ewa.h"
#include "renderer/engines/ewa/splats_of_samples.h"
#include "renderer/engines/onepass/render_onepass.h"

namespace relief {

Result<RenderResult> render(const PatchModel& model, const RenderSettings& settings,
                            Progress& progress) {
  if (settings.engine == EngineKind::Ewa)
    return ewa::render(ewa::splats_of_samples(model), settings, progress);
  return onepass::render(model, settings);
}

Result<RenderResult> render(const SplatCloud& splats, const RenderSettings& settings,
                            Progress& progress) {
  return ewa::render(splats, settings, progress);
}

}  // namespace relief
