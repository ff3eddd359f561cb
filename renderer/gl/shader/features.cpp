#include "renderer/gl/shader/features.h"

#include <array>

namespace relief {
namespace {

/// Features that need all of some others.
struct Need {
  std::uint32_t feature;
  std::uint32_t needs;
  const char* otherwise;
};
constexpr std::array kFeatureNeeds{
    Need{RELIEF_FEATURE_FRONT, RELIEF_FEATURE_SPRITE, "only sprites need front"},
    Need{RELIEF_FEATURE_FINE_COLOURS, RELIEF_FEATURE_COLOURS, "fine colours need colours"},
    Need{RELIEF_FEATURE_VISIBILITY, RELIEF_FEATURE_CELL, "only cells have a visibility buffer"},
    Need{RELIEF_FEATURE_LAYERED, RELIEF_FEATURE_VISIBILITY, "layers need a visibility buffer"},
    Need{RELIEF_FEATURE_TWO_INTERFACES, RELIEF_FEATURE_GLASS | RELIEF_FEATURE_VISIBILITY,
         "two interfaces need glass and a visibility buffer"},
    Need{RELIEF_FEATURE_SPLIT, RELIEF_FEATURE_LIT | RELIEF_FEATURE_MIRROR,
         "a split view needs lit and mirror"},
    Need{RELIEF_FEATURE_ROUGH, RELIEF_FEATURE_MIXED, "rough is for several materials"},
    Need{RELIEF_FEATURE_ENVIRONMENT_LIGHT, RELIEF_FEATURE_LIT,
         "only lit is in the light of an environment"},
    Need{RELIEF_FEATURE_CLIP_WICKE, RELIEF_FEATURE_CLIPPED, "Wicke's rule is one of clipping"},
    Need{RELIEF_FEATURE_OUT_CLIP, RELIEF_FEATURE_CLIPPED, "what clips is shown where it clips"},
    Need{RELIEF_FEATURE_POINT_LIGHTS, RELIEF_FEATURE_LIT, "only lit has point lights"}};

/// Features of which an image has one at most.
struct Rivals {
  std::uint32_t features;
  const char* clause;
};
constexpr std::array kFeatureRivals{
    Rivals{RELIEF_FEATURE_SPRITE | RELIEF_FEATURE_CELL | RELIEF_FEATURE_LARGE_SPRITES,
           "an image has one primitive"},
    Rivals{RELIEF_FEATURE_LAYERED | RELIEF_FEATURE_COUNT_FRAGMENTS, "layers are not counted"},
    Rivals{RELIEF_FEATURE_LAYERED | RELIEF_FEATURE_TWO_INTERFACES,
           "glass with two interfaces has no layers"}};

}  // namespace

const char* contradiction_in(Features features) {
  for (const Need& need : kFeatureNeeds) {
    if (features.has(need.feature) && (features.bits & need.needs) != need.needs)
      return need.otherwise;
  }
  for (const Rivals& rivals : kFeatureRivals) {
    const std::uint32_t found = features.bits & rivals.features;
    if ((found & (found - 1)) != 0) return rivals.clause;
  }
  const bool has_light = features.lights > 0 || features.has(RELIEF_FEATURE_ENVIRONMENT_LIGHT);
  if (features.has(RELIEF_FEATURE_LIT) != has_light) return "lit and only lit has lights";
  return nullptr;
}

}  // namespace relief
