#include "viewer/inspecting/inspection.h"

#include "shaders/include/shared.h"

namespace relief {

Inspection next_inspection(Inspection inspection, int steps) {
  const int count = static_cast<int>(kInspections.size());
  return static_cast<Inspection>((static_cast<int>(inspection) + steps + count) % count);
}

std::optional<int> inspected_output(Inspection inspection) {
  switch (inspection) {
    case Inspection::Patches:
      return shared::kInspectPatches;
    case Inspection::Normals:
      return shared::kInspectNormals;
    case Inspection::Levels:
      return shared::kInspectLevels;
    case Inspection::Cells:
      return shared::kInspectCells;
    case Inspection::Samples:
      return shared::kInspectSamples;
    case Inspection::Overdraw:
      return shared::kInspectOverdraw;
    case Inspection::Picture:
    case Inspection::Distance:
    case Inspection::Difference:
      break;
  }
  return {};
}

RenderSettings inspected(RenderSettings look, Inspection inspection) {
  if (!inspected_output(inspection)) return look;
  look.shows_environment = false;
  look.eye_dome = 0.0;
  if (inspection == Inspection::Overdraw) {
    look.count_fragments = true;
    look.samples = 1;
    return look;
  }
  look.material = Material::Unlit;
  look.constants = {};
  look.materials.clear();
  look.outputs.normal = true;
  look.outputs.patch_id = true;
  look.outputs.uv = inspection == Inspection::Cells || inspection == Inspection::Samples;
  return look;
}

}  // namespace relief
