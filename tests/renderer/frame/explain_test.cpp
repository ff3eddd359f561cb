// What is recorded of an image: what its scene uses, and nothing else.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/gl/shader/feature_names.h"
#include "renderer/store/maps/atlas.h"
#include "shaders/include/shared.h"
#include "tests/renderer/images.h"

namespace relief {
namespace {

using test::all_methods;
using test::must_render;
using test::small_image;
using Names = std::vector<std::string>;

Explanation explain(const PatchModel& model, RenderSettings settings) {
  settings.explain = true;
  const RenderResult result = must_render(model, settings);
  EXPECT_TRUE(result.explanation);
  return result.explanation.value_or(Explanation{});
}

const Explanation::Memory* find(const std::vector<Explanation::Memory>& all, const char* name) {
  const auto found =
      std::find_if(all.begin(), all.end(), [name](const auto& m) { return m.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::uint64_t bytes_of(const std::vector<Explanation::Memory>& all, const char* name) {
  const Explanation::Memory* const memory = find(all, name);
  EXPECT_NE(memory, nullptr) << name;
  return memory == nullptr ? 0 : memory->bytes;
}

bool has(const Names& names, const char* name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

PatchModel flat(std::uint32_t nodes) {
  return test::height_field(nodes, [](double, double) { return 0.0; });
}

test::SphereShape coloured_sphere() {
  test::SphereShape shape;
  shape.spacing = 0.1;
  shape.coloured = true;
  return shape;
}

/// Texels of the layer that one square map gets.
std::uint64_t atlas_texels(std::uint32_t side) {
  const auto atlas = pack_atlas({{side, side}}, 16384, 1);
  EXPECT_TRUE(atlas);
  return std::uint64_t{atlas->size.x} * atlas->size.y;
}

/// Every way to draw on OpenGL.
std::vector<RenderSettings> ways_to_draw(const PatchModel& model) {
  std::vector<RenderSettings> all;
  RenderSettings settings = small_image(model);
  for (const test::Method& method : all_methods()) {
    settings.primitive = method.primitive;
    settings.interpolation = method.interpolation;
    all.push_back(settings);
  }
  settings.engine = "multipass";
  for (const Primitive primitive : {Primitive::Sprite, Primitive::Quad}) {
    settings.primitive = primitive;
    all.push_back(settings);
  }
  return all;
}

TEST(FeatureNames, AreThoseOfTheShaders) {
  EXPECT_EQ(feature_names(RELIEF_FEATURE_LIT | RELIEF_FEATURE_OUT_NORMAL),
            (Names{"lit", "out_normal"}));
  EXPECT_EQ(feature_names(0), Names{});
  EXPECT_EQ(feature_names(0x80000000U), Names{"sided"});  // the last bit
  EXPECT_EQ(feature_names({RELIEF_FEATURE_GLASS | RELIEF_FEATURE_MIXED, 16}),
            (Names{"glass", "mixed", "lights 16"}));
}

TEST(Explain, IsOffByDefault) {
  const PatchModel model = flat(4);
  EXPECT_FALSE(must_render(model, small_image(model)).explanation);
}

TEST(Explain, ChangesNoPixel) {
  const PatchModel model = test::sphere_model(coloured_sphere());
  RenderSettings settings = small_image(model);
  const RenderResult plain = must_render(model, settings);
  settings.explain = true;
  const RenderResult explained = must_render(model, settings);
  for (const char* channel : {"R", "G", "B", "A"})
    EXPECT_EQ(test::values(plain.image, channel), test::values(explained.image, channel));
  EXPECT_TRUE(plain.fragments);
  EXPECT_FALSE(explained.fragments);  // counting them takes a variant of its own
}

TEST(Explain, UnlitAndUncolouredHasNothingToShadeWith) {
  const PatchModel model = flat(8);
  for (RenderSettings settings : ways_to_draw(model)) {
    settings.material = Material::Unlit;
    const Explanation e = explain(model, settings);
    for (const char* map : {"normal maps", "colour maps", "environment", "normal sums"})
      EXPECT_EQ(find(e.textures, map), nullptr) << map;
    for (const Explanation::Variant& variant : e.variants) {
      for (const char* feature : {"lit", "mirror", "colours", "out_normal"})
        EXPECT_FALSE(has(variant.features, feature)) << variant.name << " " << feature;
    }
  }
}

TEST(Explain, CellsAreStripsWherePatchesMeetAndRunsWhereTheyOverlap) {
  PatchModel model = test::sphere_model(coloured_sphere());
  const auto programs = [&] {
    std::set<std::string> names;
    const Explanation e = explain(model, small_image(model));
    for (const auto& variant : e.variants) names.insert(variant.name);
    return names;
  };
  EXPECT_TRUE(programs().contains("cells"));
  EXPECT_FALSE(programs().contains("cell strips"));
  model.joined = {{0, static_cast<std::uint32_t>(model.patches.size())}};
  EXPECT_FALSE(programs().contains("cells"));
  EXPECT_TRUE(programs().contains("cell strips"));
}

TEST(Explain, EachFeatureBringsItsMap) {
  const PatchModel model = test::sphere_model(coloured_sphere());
  for (const std::string_view engine : {"onepass", "multipass"}) {
    RenderSettings settings = small_image(model);
    settings.engine = engine;
    settings.material = Material::Unlit;
    Explanation e = explain(model, settings);
    EXPECT_TRUE(has(e.features, "colours"));
    EXPECT_NE(find(e.textures, "colour maps"), nullptr);
    EXPECT_EQ(find(e.textures, "normal maps"), nullptr);

    settings.material = Material::Lit;
    e = explain(model, settings);
    EXPECT_TRUE(has(e.features, "lit"));
    EXPECT_NE(find(e.textures, "normal maps"), nullptr);
    EXPECT_EQ(find(e.textures, "environment"), nullptr);

    settings.material = Material::Mirror;
    e = explain(model, settings);
    EXPECT_TRUE(has(e.features, "mirror"));
    EXPECT_NE(find(e.textures, "environment"), nullptr);
    EXPECT_EQ(find(e.textures, "colour maps"), nullptr);
  }
}

/// Expects that every buffer and texture is bound to a draw call.
void expect_all_bound(const PatchModel& model, const RenderSettings& settings) {
  const Explanation e = explain(model, settings);
  for (const auto* const kind : {&e.buffers, &e.textures}) {
    EXPECT_FALSE(kind->empty());
    for (const Explanation::Memory& memory : *kind) {
      EXPECT_TRUE(memory.bound) << settings.engine << " "
                                << name_of(kPrimitives, settings.primitive) << " " << memory.name;
    }
  }
}

TEST(Explain, OneSampleAPixelHasNothingToResolve) {
  const PatchModel model = flat(8);
  for (RenderSettings settings : ways_to_draw(model)) {
    const Explanation once = explain(model, settings);
    settings.samples = 4;
    const Explanation often = explain(model, settings);
    EXPECT_EQ(find(once.textures, "resolved colour"), nullptr);
    EXPECT_FALSE(has(once.passes, "resolve"));
    // Half floats of four channels, as the samples.
    EXPECT_EQ(bytes_of(often.textures, "resolved colour"), 8U * settings.width * settings.height);
    EXPECT_EQ(bytes_of(often.textures, "colour"), 4U * bytes_of(once.textures, "colour"));
    ASSERT_FALSE(often.passes.empty());
    EXPECT_EQ(often.passes.back(), "resolve");
    EXPECT_EQ(often.passes.size(), once.passes.size() + 1);
  }
}

TEST(Explain, GeometryBesideSeveralSamplesIsAFrameOfItsOwn) {
  const PatchModel model = flat(8);
  RenderSettings settings = small_image(model);
  settings.outputs.depth = true;
  settings.samples = 4;
  const Explanation e = explain(model, settings);
  EXPECT_EQ(e.passes, (Names{"visibility", "shading", "visibility", "shading", "resolve"}));
  EXPECT_TRUE(has(e.features, "out_depth"));
  const auto maps = std::count_if(e.textures.begin(), e.textures.end(),
                                  [](const auto& t) { return t.name == "normal maps"; });
  EXPECT_EQ(maps, 1);  // the model is there once
}

TEST(Explain, EveryListedResourceIsBound) {
  const PatchModel model = test::sphere_model(coloured_sphere());
  for (RenderSettings settings : ways_to_draw(model)) {
    expect_all_bound(model, settings);
    settings.outputs = test::all_outputs();
    expect_all_bound(model, settings);
  }
  RenderSettings mirror = small_image(model);
  mirror.material = Material::Mirror;
  expect_all_bound(model, mirror);
}

TEST(Explain, CountsTheAllocatedBytes) {
  constexpr std::uint32_t kNodes = 8;
  const PatchModel model = flat(kNodes);
  RenderSettings settings = small_image(model);
  settings.primitive = Primitive::Quad;
  settings.interpolation = Interpolation::Corrected;
  settings.material = Material::Mirror;
  const Explanation e = explain(model, settings);
  const std::uint64_t pixels = std::uint64_t{settings.width} * settings.height;
  EXPECT_EQ(bytes_of(e.textures, "colour"), 8 * pixels);        // RGBA16F
  EXPECT_EQ(bytes_of(e.textures, "depth buffer"), 4 * pixels);  // 32-bit float
  EXPECT_EQ(bytes_of(e.buffers, "sample records"), 16 * kNodes * kNodes);
  // A column and a row beyond the last; two bytes a node.
  EXPECT_EQ(bytes_of(e.textures, "height maps"), 2 * atlas_texels(kNodes + 1));
  // A ring of texels around; two 16-bit numbers each.
  EXPECT_EQ(bytes_of(e.textures, "normal maps"), 4 * atlas_texels(kNodes + 2));
  // The built-in cube: six faces of 512 texels a side, RGBA16F, and all levels down to one texel:
  // (4^10 - 1) / 3 texels a face.
  EXPECT_EQ(bytes_of(e.textures, "environment"), std::uint64_t{6} * 8 * ((1U << 20U) - 1) / 3);
  EXPECT_TRUE(find(e.textures, "colour")->target);
  EXPECT_FALSE(find(e.textures, "normal maps")->target);
}

TEST(Explain, ReportsPassesAndDraws) {
  const PatchModel model = flat(8);  // one patch, so one command of each draw
  RenderSettings settings = small_image(model);
  settings.primitive = Primitive::Quad;
  Explanation e = explain(model, settings);
  EXPECT_EQ(e.passes, Names{"onepass"});
  ASSERT_EQ(e.draws.size(), 1U);
  EXPECT_EQ(e.draws[0].pass, "onepass");
  EXPECT_EQ(e.draws[0].program, "quads");
  EXPECT_EQ(e.draws[0].primitive, "triangles");
  EXPECT_EQ(e.draws[0].commands, 1U);
  ASSERT_EQ(e.variants.size(), 1U);
  EXPECT_TRUE(e.variants[0].drawn);

  settings.primitive = Primitive::Cell;
  e = explain(model, settings);
  EXPECT_EQ(e.passes, (Names{"visibility", "shading"}));
  ASSERT_EQ(e.draws.size(), 3U);
  EXPECT_EQ(e.draws[0].primitive, "triangle strip");
  EXPECT_EQ(e.draws[1].program, "border cells");
  EXPECT_EQ(e.draws[2].program, "shading");
  const std::uint64_t pixels = std::uint64_t{settings.width} * settings.height;
  EXPECT_EQ(bytes_of(e.textures, "coordinates"), 8 * pixels);
  EXPECT_EQ(find(e.textures, "depths"), nullptr);

  settings.material = Material::Unlit;  // nothing that is worth being shaded later
  e = explain(model, settings);
  EXPECT_EQ(e.passes, Names{"onepass"});
  EXPECT_EQ(find(e.textures, "coordinates"), nullptr);

  settings.engine = "multipass";
  settings.material = Material::Lit;
  settings.primitive = Primitive::Sprite;
  e = explain(model, settings);
  EXPECT_EQ(e.passes, (Names{"visibility", "accumulation", "shading"}));
  ASSERT_EQ(e.draws.size(), 3U);
  EXPECT_EQ(e.draws[0].primitive, "points");
  EXPECT_EQ(e.draws[2].pass, "shading");
}

}  // namespace
}  // namespace relief
