#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "viewer/choices/differences.h"
#include "viewer/choices/engine_choices.h"
#include "viewer/choices/key_light.h"
#include "viewer/choices/material_choices.h"

namespace relief {
namespace {

const EngineEntry& engine(const char* name) {
  return *find_engine(name);
}

MaterialChoice material(const std::string& name) {
  const auto all = material_choices();
  return *std::find_if(all.begin(), all.end(), [&](const auto& c) { return c.name == name; });
}

TEST(MaterialChoices, AreThoseOfTheCommandLineAndARoughMirror) {
  const auto all = material_choices();
  ASSERT_EQ(all.size(), kMaterials.size() + 1);
  for (const auto& [name, kind] : kMaterials)
    EXPECT_EQ(material(std::string(name)), (MaterialChoice{std::string(name), kind, false}));
  EXPECT_EQ(material("rough mirror"), (MaterialChoice{"rough mirror", Material::Mirror, true}));
}

TEST(MaterialChoices, AreFoundAgainInALook) {
  for (const MaterialChoice& choice : material_choices()) {
    SceneSettings look;
    choose_material(look, choice, {});
    const MaterialSettings made = material_of(look);
    EXPECT_EQ(choice_of(made.kind, made.constants), choice) << choice.name;
  }
}

TEST(MaterialChoices, BeginWithWhatWasChosenBefore) {
  MaterialConstants remembered;
  remembered.roughness = 0.65F;
  remembered.ior = 1.25F;
  SceneSettings look;
  choose_material(look, material("rough mirror"), remembered);
  EXPECT_EQ(material_of(look).constants.roughness, 0.65F);
  choose_material(look, material("mirror"), remembered);
  EXPECT_EQ(material_of(look).constants.roughness, 0.0F);
  choose_material(look, material("glass"), remembered);
  EXPECT_EQ(material_of(look).constants.ior, 1.25F);
}

TEST(MaterialChoices, HaveRoughnessesOfWholeSteps) {
  EXPECT_FLOAT_EQ(stepped_roughness(0.32F), 0.3F);
  EXPECT_FLOAT_EQ(stepped_roughness(0.33F), 0.35F);
  EXPECT_FLOAT_EQ(stepped_roughness(-1.0F), 0.0F);
  EXPECT_FLOAT_EQ(stepped_roughness(7.0F), 1.0F);
}

TEST(EngineChoices, AreThoseThatDrawTheModelInAWindow) {
  const PatchModel patches;
  std::vector<std::string> names;
  for (const EngineEntry* found : engines_for(RenderModel::of(patches)))
    names.push_back(found->name);
  EXPECT_NE(std::find(names.begin(), names.end(), "onepass"), names.end());
  EXPECT_NE(std::find(names.begin(), names.end(), "multipass"), names.end());
  EXPECT_EQ(std::find(names.begin(), names.end(), "raytrace"), names.end());
}

TEST(EngineChoices, DropWhatAnEngineCannotDraw) {
  SceneSettings look;
  look.options = {{"primitive", "cell"}, {"samples", 16.0}, {"pixels-per-sample", 2.0}};
  look.opacity = 0.5;
  look.interfaces = 2;
  look.material = Material::Split;
  choose_engine(look, engine("multipass"));
  EXPECT_EQ(look.engine, "multipass");
  // It has no cells, draws opaque surfaces only, and its splats blend.
  EXPECT_EQ(look.options, (OptionValues{{"samples", 16.0}, {"pixels-per-sample", 2.0}}));
  EXPECT_FALSE(look.opacity);
  EXPECT_FALSE(look.interfaces);
  EXPECT_EQ(look.material, Material::Lit);
}

TEST(EngineChoices, KeepWhatAnEngineCanDraw) {
  SceneSettings look;
  look.options = {{"primitive", "cell"}};
  look.opacity = 0.5;
  look.material = Material::Split;
  const SceneSettings before = look;
  choose_engine(look, engine("onepass"));
  EXPECT_EQ(look.options, before.options);
  EXPECT_EQ(look.opacity, before.opacity);
  EXPECT_EQ(look.material, before.material);
}

TEST(EngineChoices, DropWhatAPrimitiveCannotDraw) {
  SceneSettings look;
  look.opacity = 0.5;
  choose_value(look, engine("onepass"), "interpolation", std::string("direct"));
  EXPECT_EQ(look.opacity, 0.5);
  choose_value(look, engine("onepass"), "primitive", std::string("quad"));
  EXPECT_FALSE(look.opacity);
}

TEST(EngineChoices, OfferRangesOfTheEnginesTables) {
  for (const EngineEntry& entry : engines()) {
    for (const EngineOption& option : entry.options) {
      if (option.row.kind == OptionKind::Choice || option.row.kind == OptionKind::Text) continue;
      const NumberChoice range = offered_range(option.row);
      EXPECT_EQ(range.min, option.row.range.min) << option.row.key;
      EXPECT_LE(range.max, option.row.range.max) << option.row.key;
      EXPECT_LT(range.min, range.max) << option.row.key;
    }
  }
  EXPECT_EQ(offered_samples(), (std::vector<int>{1, 4, 9, 16, 25, 36, 49, 64}));
  EXPECT_EQ(label_of("pixels-per-sample"), "Pixels per sample");
}

TEST(KeyLight, ComesFromWhereItsAnglesSay) {
  const Stance stance = kZUp;  // in front is -y
  const auto toward = [&](double azimuth, double elevation) {
    return light_of({azimuth, elevation, 1.0F}, stance).position;
  };
  // Sines and cosines of whole quarters are off by 1e-16.
  EXPECT_LT(glm::distance(toward(0.0, 0.0), {0.0, -1.0, 0.0}), 1e-15);
  EXPECT_LT(glm::distance(toward(90.0, 0.0), {1.0, 0.0, 0.0}), 1e-15);
  EXPECT_LT(glm::distance(toward(123.0, 90.0), {0.0, 0.0, 1.0}), 1e-15);
}

TEST(KeyLight, IsFoundAgainInItsLight) {
  const Stance stance = stance_of(glm::dvec3(0.3, 1.0, -0.2));
  for (const double azimuth : {-170.0, -35.0, 0.0, 90.0}) {
    for (const double elevation : {-60.0, 0.0, 45.0}) {
      const KeyLight key = key_light_of(light_of({azimuth, elevation, 1.5F}, stance), stance);
      // Rounding of a few operations in double precision, in degrees.
      EXPECT_NEAR(key.azimuth_degrees, azimuth, 1e-10);
      EXPECT_NEAR(key.elevation_degrees, elevation, 1e-10);
      EXPECT_EQ(key.intensity, 1.5F);
    }
  }
}

/// "material: lit | mirror" and so on.
std::vector<std::string> texts(const RenderSettings& a, const RenderSettings& b,
                               const SceneSettings& asked_a = {},
                               const SceneSettings& asked_b = {}) {
  std::vector<std::string> list;
  for (const Difference& d : differences_of({asked_a, a}, {asked_b, b}))
    list.push_back(d.what + ": " + d.first + " | " + d.second);
  return list;
}

TEST(Differences, AreNoneBetweenEqualLooks) {
  EXPECT_TRUE(texts({}, {}).empty());
}

TEST(Differences, NameMaterialsAndTheirParameters) {
  RenderSettings a;
  RenderSettings b;
  b.material = Material::Mirror;
  EXPECT_EQ(texts(a, b), std::vector<std::string>{"material: lit | mirror"});
  a.material = Material::Mirror;
  b.constants.roughness = 0.35F;
  EXPECT_EQ(texts(a, b),
            (std::vector<std::string>{"material: mirror | rough mirror", "roughness: 0 | 0.35"}));
}

TEST(Differences, LeaveOutParametersThatAreNotSeen) {
  RenderSettings a;
  RenderSettings b;
  b.constants.ior = 2.0F;  // of glass, and both are lit
  b.constants.roughness = 0.5F;
  EXPECT_TRUE(texts(a, b).empty());
}

TEST(Differences, NameEnginesAndOptionsThatBothHave) {
  const RenderSettings a;
  RenderSettings b;
  b.samples = 16;
  b.pixels_per_sample = 8.0;
  EXPECT_EQ(texts(a, b), (std::vector<std::string>{"samples: 1 | 16", "pixels per sample: 4 | 8"}));
  RenderSettings c = default_settings(engine("multipass"));
  EXPECT_EQ(texts(a, c),
            (std::vector<std::string>{"engine: onepass | multipass", "primitive: cell | quad"}));
}

TEST(Differences, NameLightAndExposure) {
  const RenderSettings a;
  RenderSettings b;
  b.environment = "/maps/studio.exr";
  b.lights.from_environment = true;
  SceneSettings brighter;
  brighter.exposure = 1.5;
  EXPECT_EQ(texts(a, b, {}, brighter),
            (std::vector<std::string>{"environment: built-in | studio", "exposure: 0 | 1.5"}));
  SceneSettings turned;
  turned.environment_rotation_degrees = 30.0;
  EXPECT_EQ(texts(b, b, {}, turned), (std::vector<std::string>{"environment's rotation: 0 | 30"}));
  brighter.lights = b.lights.list = {Light{}};
  EXPECT_EQ(texts(a, b, {}, brighter),
            (std::vector<std::string>{"environment: built-in | studio",
                                      "light: camera | environment and own", "exposure: 0 | 1.5"}));
}

}  // namespace
}  // namespace relief
