// The values of a volume, classified and shaded at every place of a ray.
#pragma once

#include <optional>

#include "common/bounds.h"
#include "common/progress.h"
#include "common/volume/transfer_function.h"
#include "renderer/engines/volume_truth/sample_image.h"
#include "renderer/engines/volume_truth/value_field.h"
#include "renderer/shading/shading.h"

namespace relief::volume_truth {

/// What a ray goes through.
struct FieldScene {
  const ValueField& field;
  const RegularGrid& grid;
  const TransferFunction& function;
  const Lighting* lighting = nullptr;  ///< null: colours are shown as they are
  std::optional<double> iso;           ///< each crossing of this value is a surface
  double iso_opacity = 0.0;
  std::optional<Bounds> clip = {};  ///< world; what lies outside is not there
};

/// Fills the image's rays. A ray is cut at the faces of cells, at the surface and every `step`
/// spacings, and these parts in halves until that no longer changes them. Gives up if `progress`
/// is cancelled.
void integrate_field(const FieldScene& scene, const View& view, double step, SampleImage& into,
                     Progress& progress);

}  // namespace relief::volume_truth
