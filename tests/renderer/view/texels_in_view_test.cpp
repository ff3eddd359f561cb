// A distant image keeps no fine texels.
#include "renderer/view/texels_in_view.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <string_view>

#include "common/octahedral.h"
#include "tests/renderer/images.h"

namespace relief {
namespace {

constexpr std::uint32_t kSheetNodes = 17;
constexpr std::uint32_t kTexelsPerCell = 8;

template <class Texel, class Value>
AttributeMap<Texel> map_of(std::uint32_t scale, const Value& value) {
  const std::uint32_t side = scale * (kSheetNodes - 1) + 1;
  AttributeMap<Texel> map{side, side, scale, {}};
  for (std::uint32_t j = 0; j < side; ++j) {
    for (std::uint32_t i = 0; i < side; ++i) map.texels.push_back(value(i, j));
  }
  return map;
}

/// A level square, cells of 1, with colours in waves of eight texels and fine normals.
PatchModel fine_square() {
  PatchModel model = test::height_field(kSheetNodes, [](double, double) { return 0.0; });
  model.has_colours = true;
  Patch& patch = model.patches.front();
  patch.colours = map_of<glm::u8vec3>(kTexelsPerCell, [](std::uint32_t i, std::uint32_t j) {
    return (i + j) / 4 % 2 == 0 ? glm::u8vec3(40, 60, 80) : glm::u8vec3(200, 180, 160);
  });
  patch.normals = map_of<glm::i16vec2>(kTexelsPerCell, [](std::uint32_t i, std::uint32_t) {
    return snorm16_from_unit(glm::normalize(glm::vec3(i % 4 < 2 ? 0.3F : -0.3F, 0.0F, 1.0F)));
  });
  return model;
}

/// From above, a pixel `cells` cells wide.
RenderSettings seen_from_above(const PatchModel& model, double cells) {
  RenderSettings settings = test::small_image(model);
  settings.width = settings.height = 64;
  settings.material = Material::Unlit;
  settings.camera = {{0.0, 0.0, 100.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 45.0};
  settings.camera.orthographic_height = 64.0 * cells;
  return settings;
}

/// Texels a cell that a view leaves.
struct Scales {
  std::uint32_t colours;
  std::uint32_t normals;
  bool operator==(const Scales&) const = default;
};

Scales scales_after(PatchModel& model, const RenderSettings& settings, bool are_labels = false) {
  const std::vector<Transform> transforms(1);
  const auto onlookers = onlookers_of({&settings, 1}, transforms, model);
  drop_unseen_texels(onlookers, model.patches, are_labels);
  return {model.patches.front().colours.scale, model.patches.front().normals.scale};
}

TEST(TexelsInView, AHalvedMapLiesWhereItDid) {
  // A ramp: means keep it, but for its ends.
  const auto ramp = map_of<glm::u8vec3>(4, [](std::uint32_t i, std::uint32_t) {
    return srgb8_from_linear(glm::vec3(static_cast<float>(i) / 64.0F));
  });
  const AttributeMap<glm::u8vec3> half = halved(ramp);
  EXPECT_EQ(half.scale, 2U);
  ASSERT_EQ(half.width, 2 * (kSheetNodes - 1) + 1);
  ASSERT_EQ(half.texels.size(), std::size_t{half.width} * half.height);
  for (std::uint32_t i = 1; i + 1 < half.width; ++i) {
    EXPECT_NEAR(half.texels[half.width + i].r, ramp.texels[2 * i].r, 1) << i;  // rounded twice
  }
  const auto bent = map_of<glm::i16vec2>(2, [](std::uint32_t, std::uint32_t) {
    return snorm16_from_unit(glm::normalize(glm::vec3(0.2F, -0.1F, 1.0F)));
  });
  for (const glm::i16vec2 texel : halved(bent).texels)
    EXPECT_GT(glm::dot(unit_from_snorm16(texel), unit_from_snorm16(bent.texels[0])), 0.999999F);
}

TEST(TexelsInView, FollowTheDistance) {
  const PatchModel whole = fine_square();
  // Four texels a pixel are kept, and more only until a halving leaves as many.
  for (const auto& [cells, scale] :
       {std::pair{0.4, 8U}, std::pair{0.9, 8U}, std::pair{1.01, 4U}, std::pair{2.01, 2U},
        std::pair{4.01, 1U}, std::pair{40.0, 1U}}) {
    PatchModel model = whole;
    const std::uint32_t expected = cells < 1.0 ? 8U : scale;
    EXPECT_EQ(scales_after(model, seen_from_above(model, cells)), (Scales{expected, expected}))
        << cells;
  }
}

TEST(TexelsInView, AreThoseOfTheNearestOfSeveralViews) {
  PatchModel model = fine_square();
  const std::vector<RenderSettings> views{seen_from_above(model, 40.0),
                                          seen_from_above(model, 1.5)};
  const std::vector<Transform> transforms(1);
  drop_unseen_texels(onlookers_of(views, transforms, model), model.patches, false);
  EXPECT_EQ(model.patches.front().colours.scale, 4U);
  // A larger instance is nearer.
  model = fine_square();
  std::vector<Transform> large(2);
  large[1].scale = 30.0;
  drop_unseen_texels(onlookers_of({views.data(), 1}, large, model), model.patches, false);
  EXPECT_EQ(model.patches.front().colours.scale, 4U);
}

TEST(TexelsInView, LabelsAreNotMixed) {
  PatchModel model = fine_square();
  const auto before = model.patches.front().colours.texels;
  EXPECT_EQ(scales_after(model, seen_from_above(model, 40.0), true), (Scales{8U, 1U}));
  EXPECT_EQ(model.patches.front().colours.texels, before);
}

/// No variant for fine maps, a fraction of the bytes, and the image that all texels give.
TEST(TexelsInView, ADistantImageHasNoFineMaps) {
  const PatchModel whole = fine_square();
  PatchModel model = whole;
  RenderSettings settings = seen_from_above(model, 4.1);
  settings.primitive = Primitive::Quad;  // neither levels nor proxies
  settings.explain = true;
  EXPECT_EQ(scales_after(model, settings), (Scales{1U, 1U}));
  const RenderResult fine = test::must_render(whole, settings);
  const RenderResult kept = test::must_render(model, settings);
  const auto colour_bytes = [](const RenderResult& result) {
    for (const Explanation::Memory& memory : result.explanation->textures) {
      if (memory.name == "colour maps") return memory.bytes;
    }
    return std::uint64_t{0};
  };
  ASSERT_TRUE(fine.explanation && kept.explanation);
  EXPECT_NE(std::ranges::find(fine.explanation->features, "fine_colours"),
            fine.explanation->features.end());
  EXPECT_EQ(std::ranges::find(kept.explanation->features, "fine_colours"),
            kept.explanation->features.end());
  EXPECT_LT(20 * colour_bytes(kept), colour_bytes(fine));
  // A pixel of four cells is the mean of many waves: both filters leave little of them.
  for (const char* const channel : {"R", "G", "B"}) {
    const auto& a = test::values(fine.image, channel);
    const auto& b = test::values(kept.image, channel);
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 0.03F) << channel << k;
  }
}

}  // namespace
}  // namespace relief
