// What is recorded of an image of the engine `volume`: what its drawing uses, and nothing else.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "common/volume/gaussian_cloud.h"
#include "common/volume/scalar_volume.h"
#include "renderer/render.h"

namespace relief {
namespace {

using Words = std::vector<std::string>;

ScalarVolume little_volume() {
  ScalarVolume volume;
  volume.size = {6, 7, 8};
  volume.placement = RegularGrid{glm::dvec3(-3.0), glm::dmat3(1.0)};
  for (std::size_t n = 0; n < nodes_of(volume); ++n)
    volume.values.push_back(static_cast<float>(n % 7));
  return volume;
}

GaussianCloud little_cloud() {
  GaussianCloud cloud;
  cloud.centres = {{0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}};
  cloud.scales.assign(2, glm::vec3(0.5F));
  cloud.rotations.assign(2, glm::quat(1.0F, 0.0F, 0.0F, 0.0F));
  cloud.opacities.assign(2, 0.8F);
  cloud.harmonics.assign(2, glm::vec3(0.3F));
  return cloud;
}

RenderSettings usual_settings() {
  RenderSettings settings;
  settings.engine = "volume";
  settings.width = 40;
  settings.height = 24;
  settings.camera = {{3.0, 2.0, 30.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 30.0};
  settings.volume.drawn_by = VolumeDrawingBy::Shaders;
  settings.explain = true;
  return settings;
}

template <class Model>
Explanation explained(const Model& model, const RenderSettings& settings) {
  Progress silent;
  RenderModel form;
  form.add(model);
  const auto result = render(form, settings, silent);
  EXPECT_TRUE(result) << result.error().message;
  if (!result) return {};
  EXPECT_TRUE(result->explanation);
  return result->explanation.value_or(Explanation{});
}

std::uint64_t bytes_of(const std::vector<Explanation::Memory>& all, const char* name) {
  const auto found = std::ranges::find(all, name, &Explanation::Memory::name);
  return found == all.end() ? 0 : found->bytes;
}

Words names_of(const std::vector<Explanation::Memory>& all) {
  Words names;
  for (const Explanation::Memory& memory : all) names.push_back(memory.name);
  std::ranges::sort(names);
  return names;
}

void expect_all_bound(const Explanation& e) {
  for (const auto* const kind : {&e.buffers, &e.textures}) {
    for (const Explanation::Memory& memory : *kind) EXPECT_TRUE(memory.bound) << memory.name;
  }
  ASSERT_EQ(e.draws.size(), e.passes.size());
  for (std::size_t p = 0; p < e.passes.size(); ++p) {
    EXPECT_EQ(e.draws[p].pass, e.passes[p]);
    EXPECT_EQ(e.draws[p].program, e.passes[p]);
  }
}

TEST(VolumeExplain, AGridIsSheets) {
  RenderSettings settings = usual_settings();
  settings.material = Material::Unlit;
  const Explanation e = explained(little_volume(), settings);
  expect_all_bound(e);
  EXPECT_EQ(e.passes, Words{"volume sheets"});
  EXPECT_TRUE(e.features.empty());
  EXPECT_EQ(names_of(e.buffers), (Words{"volume grid", "volume rule"}));
  EXPECT_EQ(names_of(e.textures),
            (Words{"distances", "distances in sheets", "nodes", "volume colour"}));
  EXPECT_EQ(bytes_of(e.textures, "volume colour"), 16U * 40 * 24);  // four floats a pixel
  // Four numbers of 16 bits a node; blocks of 4^3 nodes.
  EXPECT_EQ(bytes_of(e.textures, "nodes"), 8U * 6 * 7 * 8);
  EXPECT_EQ(bytes_of(e.textures, "distances"), 2U * 2 * 2);
}

TEST(VolumeExplain, LitNodesAreAPassOfTheirOwn) {
  const Explanation e = explained(little_volume(), usual_settings());
  expect_all_bound(e);
  EXPECT_EQ(e.passes, (Words{"volume nodes", "volume sheets"}));
  EXPECT_EQ(e.features, (Words{"lit", "lights 3"}));
  EXPECT_EQ(names_of(e.buffers),
            (Words{"lights", "squares of nodes", "volume grid", "volume nodes", "volume rule"}));
  EXPECT_EQ(names_of(e.textures), (Words{"distances", "distances in sheets", "lit nodes",
                                         "node normals", "nodes", "volume colour"}));
}

TEST(VolumeExplain, NormalsAndDepthsAreThereIfTheyAreAskedFor) {
  RenderSettings settings = usual_settings();
  settings.material = Material::Unlit;
  settings.outputs.normal = true;
  settings.outputs.depth = true;
  const Explanation e = explained(little_volume(), settings);
  expect_all_bound(e);
  EXPECT_EQ(e.features, (Words{"out_normal", "out_depth"}));
  EXPECT_EQ(names_of(e.textures), (Words{"distances", "distances in sheets", "node normals",
                                         "nodes", "volume colour", "volume surface"}));
}

TEST(VolumeExplain, WhatIsNoGridIsQuadsOrLists) {
  RenderSettings settings = usual_settings();
  const Explanation quads = explained(little_cloud(), settings);
  expect_all_bound(quads);
  EXPECT_EQ(quads.passes, Words{"volume quads"});
  EXPECT_EQ(bytes_of(quads.buffers, "splats"), 2U * 80);
  settings.outputs.depth = true;
  const Explanation lists = explained(little_cloud(), settings);
  expect_all_bound(lists);
  EXPECT_EQ(lists.passes, Words{"volume lists"});
  EXPECT_EQ(names_of(lists.buffers), (Words{"splats", "tile lists", "tile starts", "volume rule"}));
  EXPECT_EQ(lists.features, Words{"out_depth"});
}

TEST(VolumeExplain, OnTheCpuOnlyTheImageIsOpenGl) {
  RenderSettings settings = usual_settings();
  settings.volume.drawn_by = VolumeDrawingBy::Cpu;
  const Explanation e = explained(little_volume(), settings);
  EXPECT_EQ(e.passes, Words{"volume on the CPU"});
  EXPECT_TRUE(e.draws.empty());
  EXPECT_EQ(names_of(e.textures), Words{"volume colour"});
  EXPECT_TRUE(e.buffers.empty());
}

TEST(VolumeExplain, ChangesNoPixel) {
  Progress silent;
  const ScalarVolume volume = little_volume();
  RenderModel form;
  form.add(volume);
  RenderSettings settings = usual_settings();
  const auto with = render(form, settings, silent);
  settings.explain = false;
  const auto without = render(form, settings, silent);
  ASSERT_TRUE(with && without);
  EXPECT_FALSE(without->explanation);
  for (const char* const channel : {"R", "G", "B", "A"})
    EXPECT_EQ(with->image.find(channel)->values, without->image.find(channel)->values);
}

// A pass that draws nothing is not there.
TEST(VolumeExplain, NoKernelsAreNoPass) {
  const Explanation e = explained(GaussianCloud{}, usual_settings());
  EXPECT_TRUE(e.passes.empty());
  EXPECT_TRUE(e.draws.empty());
}

}  // namespace
}  // namespace relief
