// What features cost: what a scene does not have, it does not pay for.
#include "renderer/costs/feature_costs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "renderer/costs/removable_features.h"
#include "tests/renderer/images.h"

namespace relief {
namespace {

using test::must_render;
using test::small_image;
using Names = std::vector<std::string>;

FeatureCosts costs_of(const PatchModel& model, RenderSettings settings, int turns = 1) {
  settings.explain = true;
  settings.cost_turns = turns;
  const RenderResult result = must_render(model, settings);
  EXPECT_TRUE(result.explanation && result.explanation->costs);
  return result.explanation && result.explanation->costs ? *result.explanation->costs
                                                         : FeatureCosts{};
}

const FeatureCost* find(const FeatureCosts& costs, const std::string& feature) {
  const auto found = std::ranges::find(costs.features, feature, &FeatureCost::feature);
  return found == costs.features.end() ? nullptr : &*found;
}

std::set<std::string> names_of(const FeatureCosts& costs) {
  std::set<std::string> names;
  for (const FeatureCost& cost : costs.features) names.insert(cost.feature);
  return names;
}

TEST(FeatureCosts, AreMeasuredOnlyWhereTheyAreAskedFor) {
  const PatchModel model = test::coarse_coloured_sphere();
  RenderSettings settings = small_image(model);
  settings.explain = true;
  const RenderResult explained = must_render(model, settings);
  ASSERT_TRUE(explained.explanation);
  EXPECT_FALSE(explained.explanation->costs);
  settings.cost_turns = 1;
  const RenderResult costed = must_render(model, settings);
  EXPECT_TRUE(costed.explanation->costs);
  for (const char* const channel : {"R", "G", "B", "A"})
    EXPECT_EQ(test::values(explained.image, channel), test::values(costed.image, channel));
  EXPECT_EQ(explained.explanation->passes, costed.explanation->passes);
}

TEST(FeatureCosts, ARowForEachFeatureOfTheScene) {
  PatchModel model = test::coarse_coloured_sphere();
  RenderSettings settings = small_image(model);
  settings.pixels_per_sample = 0.0;
  settings.material = Material::Unlit;
  EXPECT_EQ(names_of(costs_of(model, settings)), (std::set<std::string>{"colours"}));
  settings.material = Material::Lit;
  EXPECT_EQ(names_of(costs_of(model, settings)), (std::set<std::string>{"colours", "light"}));
  settings.material = Material::Mirror;
  settings.constants.roughness = 0.3F;
  settings.outputs.depth = true;
  settings.samples = 4;
  EXPECT_EQ(names_of(costs_of(model, settings)),
            (std::set<std::string>{"reflection", "rough reflection", "outputs beside colour",
                                   "samples per pixel"}));
  model.is_closed = true;
  settings = small_image(model);
  settings.cull = CullMode::Auto;
  settings.material = Material::Glass;
  settings.constants.interfaces = 2;
  EXPECT_EQ(names_of(costs_of(model, settings)),
            (std::set<std::string>{"refraction", "second interface", "levels of detail",
                                   "culling of backs"}));
  settings = small_image(model);
  settings.engine = "multipass";
  settings.primitive = Primitive::Quad;
  settings.clip.rule = ClipRule::Partners;
  settings.material = Material::Unlit;
  EXPECT_EQ(names_of(costs_of(model, settings)),
            (std::set<std::string>{"colours", "clip partners"}));
}

TEST(FeatureCosts, AreWhatTheFrameTakesMore) {
  const PatchModel model = test::coarse_coloured_sphere();
  RenderSettings settings = small_image(model);
  settings.pixels_per_sample = 0.0;
  settings.explain = true;
  const FeatureCosts costs = costs_of(model, settings, 2);
  EXPECT_EQ(costs.turns, 2);
  const auto bytes_of = [](const RenderResult& result) {
    return static_cast<std::int64_t>(bound_bytes(*result.explanation).all);
  };
  const RenderResult whole = must_render(model, settings);
  EXPECT_EQ(static_cast<std::int64_t>(costs.whole.bytes), bytes_of(whole));
  EXPECT_EQ(costs.whole.passes, (Names{"visibility", "shading"}));
  EXPECT_GT(costs.whole.frame_ms, 0.0);
  std::uint64_t lines = 0;
  for (const Explanation::Variant& variant : whole.explanation->variants)
    lines += variant.drawn ? variant.lines : 0;
  EXPECT_EQ(costs.whole.lines, lines);

  const FeatureCost* const light = find(costs, "light");
  ASSERT_NE(light, nullptr);
  RenderSettings unlit = settings;
  unlit.material = Material::Unlit;
  EXPECT_EQ(light->bytes, bytes_of(whole) - bytes_of(must_render(model, unlit)));
  EXPECT_GT(light->bytes, 0);
  EXPECT_EQ(light->passes, (Names{"visibility", "shading"}));
  EXPECT_EQ(light->saved_passes, Names{"onepass"});
  EXPECT_GT(light->lines, 0);
  EXPECT_TRUE(light->reads_normals);
  EXPECT_FALSE(light->reads_colours);

  const FeatureCost* const colours = find(costs, "colours");
  ASSERT_NE(colours, nullptr);
  EXPECT_TRUE(colours->reads_colours);
  EXPECT_FALSE(colours->reads_normals);
  EXPECT_TRUE(colours->passes.empty());
  EXPECT_GT(colours->lines, 0);

  // Neither light nor colours: what the surface itself takes.
  PatchModel plain = model;
  plain.has_colours = false;
  for (Patch& patch : plain.patches) patch.colours = {};
  EXPECT_EQ(static_cast<std::int64_t>(costs.rest.bytes), bytes_of(must_render(plain, unlit)));
}

TEST(FeatureCosts, NormalsThatAnOutputShowsAreNotPaidForByLight) {
  const PatchModel model = test::coarse_coloured_sphere();
  RenderSettings settings = small_image(model);
  settings.outputs.normal = true;
  const FeatureCosts costs = costs_of(model, settings);
  EXPECT_FALSE(find(costs, "light")->reads_normals);
  EXPECT_FALSE(find(costs, "outputs beside colour")->reads_normals);
}

/// A sphere with fine normals, half a mirror, half semi-transparent glass. It has no colours: an
/// unlit surface in place of either would show them.
PatchModel glass_and_mirror(RenderSettings& settings) {
  test::SphereShape shape;
  shape.spacing = 0.1;
  PatchModel model = test::sphere_model(shape);
  for (Patch& patch : model.patches) {
    const Patch& p = patch;
    AttributeMap<glm::i16vec2> fine{2 * (p.width - 1) + 1, 2 * (p.height - 1) + 1, 2, {}};
    for (std::uint32_t j = 0; j < fine.height; ++j) {
      for (std::uint32_t i = 0; i < fine.width; ++i)
        fine.texels.push_back(p.normals.texels[std::size_t{j / 2} * p.normals.width + i / 2]);
    }
    patch.normals = std::move(fine);
  }
  for (std::size_t p = model.patches.size() / 2; p < model.patches.size(); ++p)
    model.patches[p].material = 1;
  settings = small_image(model);
  settings.pixels_per_sample = 0.0;
  settings.materials = {{Material::Mirror, {}}, {Material::Glass, {}}};
  settings.materials[1].constants.opacity = 0.7F;
  return model;
}

TEST(FeatureCosts, GlassOverAMirrorWithFineNormals) {
  RenderSettings settings;
  const PatchModel model = glass_and_mirror(settings);
  const FeatureCosts costs = costs_of(model, settings);
  EXPECT_EQ(names_of(costs),
            (std::set<std::string>{"fine normals", "reflection", "refraction", "transparency"}));
  for (const FeatureCost& cost : costs.features) {
    EXPECT_GT(cost.lines, 0) << cost.feature;
    EXPECT_GE(cost.bytes, 0) << cost.feature;
  }
  EXPECT_GT(find(costs, "transparency")->bytes, 0);
  EXPECT_FALSE(find(costs, "transparency")->passes.empty());
  EXPECT_GT(find(costs, "fine normals")->bytes, 0);
  EXPECT_EQ(costs.rest.passes, Names{"onepass"});
  // Each of the two would read normals without the other.
  EXPECT_FALSE(find(costs, "reflection")->reads_normals);
  EXPECT_TRUE(costs.whole.reads_normals);
  EXPECT_FALSE(costs.rest.reads_normals);
}

/// Cancels after so many turns.
class Impatient final : public Progress {
 public:
  explicit Impatient(std::uint64_t turns) : turns_(turns) {}
  void begin_stage(std::string_view name, std::uint64_t) override {
    is_measuring_ = name == "leaving out features";
  }
  void advance(std::uint64_t units) override { done_ += is_measuring_ ? units : 0; }
  [[nodiscard]] bool cancelled() const override { return is_measuring_ && done_ >= turns_; }

 private:
  std::uint64_t turns_;
  std::uint64_t done_ = 0;
  bool is_measuring_ = false;
};

TEST(FeatureCosts, CanBeInterruptedBetweenFrames) {
  const PatchModel model = test::coarse_coloured_sphere();
  RenderSettings settings = small_image(model);
  settings.explain = true;
  settings.cost_turns = 1000000;
  Impatient progress(2);
  const auto result = render(RenderModel::of(model), settings, progress);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message, interrupted_error().message);
}

}  // namespace
}  // namespace relief
