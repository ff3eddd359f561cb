// Which features go together.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "renderer/engines/onepass/features.h"
#include "renderer/frame/features.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

std::string contradiction(Features features) {
  const char* const found = contradiction_in(features);
  return found == nullptr ? std::string() : found;
}

TEST(Features, OfImagesNeverContradictEachOther) {
  MaterialConstants rough;
  rough.roughness = 0.3F;
  MaterialConstants two;
  two.interfaces = 2;
  const std::vector<std::vector<MaterialSettings>> materials{
      {{Material::Unlit, {}}},
      {{Material::Lit, {}}},
      {{Material::Mirror, rough}},
      {{Material::Glass, {}}},
      {{Material::Split, {}}},
      {{Material::Lit, {}}, {Material::Mirror, rough}},
      {{Material::Unlit, {}}, {Material::Glass, {}}, {Material::Split, rough}}};
  ModelMaps maps(true);
  std::size_t checked = 0;
  for (const auto& list : materials) {
    for (unsigned bits = 0; bits < 256; ++bits) {
      const auto bit = [bits](unsigned k) { return (bits >> k & 1U) != 0; };
      RenderSettings settings;
      settings.materials = list;
      settings.primitive = bit(0) ? Primitive::Cell : bit(1) ? Primitive::Sprite : Primitive::Quad;
      settings.interpolation = bit(2) ? Interpolation::Direct : Interpolation::Corrected;
      settings.cull = bit(3) ? CullMode::Back : CullMode::None;
      settings.outputs = {bit(4), bit(4), bit(4), bit(4)};
      settings.camera.orthographic_height = bit(5) ? 2.0 : 0.0;
      if (bit(6)) settings.lights.list = {{LightKind::Point, {1.0, 2.0, 3.0}, {1, 1, 1}}};
      maps.fine_colours = maps.fine_normals = bit(7);
      EXPECT_EQ(contradiction(scene_features(settings, maps)), "") << bits;
      EXPECT_EQ(contradiction(onepass::features_of(settings, maps)), "") << bits;
      ++checked;
    }
  }
  EXPECT_EQ(checked, 7U * 256U);
  // Two interfaces, and what is semi-transparent, only cells can have (engine_checks.h).
  RenderSettings glass;
  glass.material = Material::Glass;
  glass.constants = two;
  EXPECT_EQ(contradiction(onepass::features_of(glass, maps)), "");
  glass.primitive = Primitive::Sprite;
  EXPECT_NE(contradiction(onepass::features_of(glass, maps)), "");
}

TEST(Features, ThatContradictEachOtherAreFound) {
  for (const Features impossible :
       {Features(RELIEF_FEATURE_FRONT), Features(RELIEF_FEATURE_FINE_COLOURS),
        Features(RELIEF_FEATURE_VISIBILITY), Features(RELIEF_FEATURE_CELL | RELIEF_FEATURE_LAYERED),
        Features(RELIEF_FEATURE_GLASS | RELIEF_FEATURE_CELL | RELIEF_FEATURE_TWO_INTERFACES),
        Features(RELIEF_FEATURE_SPLIT | RELIEF_FEATURE_MIRROR), Features(RELIEF_FEATURE_ROUGH),
        Features(RELIEF_FEATURE_POINT_LIGHTS), Features(RELIEF_FEATURE_LIT),
        Features(RELIEF_FEATURE_MIRROR, 3), Features(RELIEF_FEATURE_CELL | RELIEF_FEATURE_SPRITE),
        Features(RELIEF_FEATURE_CELL | RELIEF_FEATURE_VISIBILITY | RELIEF_FEATURE_LAYERED |
                 RELIEF_FEATURE_COUNT_FRAGMENTS),
        Features(RELIEF_FEATURE_GLASS | RELIEF_FEATURE_CELL | RELIEF_FEATURE_VISIBILITY |
                 RELIEF_FEATURE_LAYERED | RELIEF_FEATURE_TWO_INTERFACES)})
    EXPECT_NE(contradiction(impossible), "") << impossible.bits;
  EXPECT_EQ(contradiction({RELIEF_FEATURE_CELL | RELIEF_FEATURE_LIT, 3}), "");
}

}  // namespace
}  // namespace relief
