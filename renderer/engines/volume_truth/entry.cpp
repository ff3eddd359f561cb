// The registry's entry of the engine `volume-truth`.
#include <iterator>

#include "renderer/engines/volume_truth/render_volume_truth.h"
#include "renderer/engines/volume_truth/truth_settings.h"
#include "renderer/volume/options.h"

namespace relief::volume_truth {

EngineEntry entry() {
  std::vector<EngineOption> options = volume_options();
  std::vector<EngineOption> own = truth_options();
  options.insert(options.end(), std::make_move_iterator(own.begin()),
                 std::make_move_iterator(own.end()));
  return {.name = "volume-truth",
          .summary = "integrates volumes and 3D Gaussians exactly along rays, to judge images by",
          .forms = {ModelForm::Volume, ModelForm::Gaussians},
          .primitives = {},
          .interpolations = {},
          .capabilities = {},
          .options = std::move(options),
          .prepare = prepare};
}

}  // namespace relief::volume_truth
