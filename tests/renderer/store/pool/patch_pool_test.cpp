// A model whose patches come and go looks like one that was uploaded whole.
#include "renderer/store/pool/patch_pool.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/transform.h"
#include "renderer/viewport.h"
#include "tests/renderer/gl/draw_viewport.h"
#include "tests/renderer/gl/own_context.h"
#include "tests/renderer/images.h"
#include "tests/renderer/scenes.h"

namespace relief {
namespace {

class Pools : public testing::Test {
 protected:
  Pools() {
    test::SphereShape shape;
    shape.bumps = 0.1;
    shape.patches_per_side = 3;
    shape.coloured = true;
    model_ = test::sphere_model(shape);
    extent_ = without_patches(model_);
  }

  [[nodiscard]] GlLoader loader() const { return context_.loader(); }
  [[nodiscard]] const Gl& gl() const { return context_.gl(); }

  PatchPool make_pool(const RenderSettings& look) {
    needs_ = pool_needs(extent_, {&look, 1});
    return {gl(), needs_, {.body = {model_.bounds, {}}, .is_closed = model_.is_closed}};
  }

  /// Patches `first` to `first + count - 1` of the model.
  PatchChunk chunk_of(std::uint32_t first, std::uint32_t count, std::uint32_t finest = 0) {
    PatchModel part = extent_;
    part.patches.assign(model_.patches.begin() + first, model_.patches.begin() + first + count);
    if (!model_.joined.empty()) part.joined = {{0, count, model_.joined.front().is_closed}};
    std::vector<std::uint32_t> ids(count);
    std::iota(ids.begin(), ids.end(), first);
    auto chunk = prepare_chunk(part, ids, needs_, store_limits(gl()), finest);
    EXPECT_TRUE(chunk) << chunk.error().message;
    return *std::move(chunk);
  }

  Image draw(Viewport& viewport, const RenderSettings& view) {
    return test::draw(gl(), viewport, view);
  }
  Image draw(const PatchPool& pool, const RenderSettings& view) {
    const auto viewport = Viewport::create(loader(), extent_, pool, {&view, 1});
    EXPECT_TRUE(viewport) << viewport.error().message;
    return draw(**viewport, view);
  }
  Image draw_whole(const RenderSettings& view) {
    const auto viewport = Viewport::create(loader(), RenderModel::of(model_), {&view, 1});
    EXPECT_TRUE(viewport) << viewport.error().message;
    return draw(**viewport, view);
  }

  static void expect_same(const Image& a, const Image& b, const std::string& what) {
    EXPECT_EQ(test::values(a, "A"), test::values(b, "A")) << what;
    std::size_t beyond = 0;
    for (const char* const channel : {"R", "G", "B"}) {
      const std::vector<float>& of_a = test::values(a, channel);
      const std::vector<float>& of_b = test::values(b, channel);
      for (std::size_t p = 0; p < of_a.size(); ++p) {
        if (std::abs(srgb8_from_linear(of_a[p]) - srgb8_from_linear(of_b[p])) > 1) ++beyond;
      }
    }
    // Where two patches overlap at the same depth the one that is drawn first is seen, and chunks
    // are drawn in another order.
    EXPECT_LE(beyond, 3 * test::values(a, "R").size() / 1000) << what;
  }

  test::OwnContext context_;
  PatchModel model_;
  PatchModel extent_;
  StoreNeeds needs_;
};

std::vector<RenderSettings> looks_at(const PatchModel& model) {
  // Larger than what is drawn from afar (renderer/geometry/proxy/proxy.h), which a pool does not.
  std::vector<RenderSettings> looks(4, test::small_image(model, {20.0, 15.0}, 192));
  looks[1].material = Material::Unlit;
  looks[2].primitive = Primitive::Sprite;
  looks[3].engine = "multipass";
  for (RenderSettings& look : looks) look.background = std::nullopt;
  return looks;
}

TEST_F(Pools, OfAllChunksAreDrawnAsTheWholeModel) {
  for (const RenderSettings& look : looks_at(model_)) {
    PatchPool pool = make_pool(look);
    std::vector<ShownChunk> shown;
    for (std::uint32_t first = 0; first < 54; first += 6) {
      const auto slot = pool.add(chunk_of(first, 6));
      ASSERT_TRUE(slot) << slot.error().message;
      shown.push_back({*slot});
    }
    pool.show(shown);
    expect_same(draw(pool, look), draw_whole(look),
                look.engine + " " + std::to_string(static_cast<int>(look.primitive)));
  }
}

TEST_F(Pools, AreDrawnTheSameHoweverOftenChunksHaveComeAndGone) {
  const RenderSettings look = looks_at(model_).front();
  PatchPool pool = make_pool(look);
  std::vector<ChunkSlot> slots;
  for (std::uint32_t first = 0; first < 54; first += 3)
    slots.push_back(*pool.add(chunk_of(first, 3)));
  // The viewport stays while buffers are replaced, as a window's does.
  pool.show(std::vector<ShownChunk>{{slots[0]}});
  const auto viewport = Viewport::create(loader(), extent_, pool, {&look, 1});
  ASSERT_TRUE(viewport);
  static_cast<void>(draw(**viewport, look));
  const std::uint64_t bytes = pool.bytes();
  for (int round = 0; round < 4; ++round) {
    for (std::uint32_t c = round % 2; c < 18; c += 2) pool.remove(slots[c]);
    for (std::uint32_t c = round % 2; c < 18; c += 2) slots[c] = *pool.add(chunk_of(3 * c, 3));
  }
  EXPECT_EQ(pool.bytes(), bytes) << "what is given back is taken again";
  std::vector<ShownChunk> shown;
  for (const ChunkSlot slot : slots) shown.push_back({slot});
  pool.show(shown);
  expect_same(draw(**viewport, look), draw_whole(look), "after four rounds");
}

TEST_F(Pools, GrowWhileTheyAreDrawn) {
  const RenderSettings look = looks_at(model_).front();
  PatchPool pool = make_pool(look);
  std::vector<ShownChunk> shown{{*pool.add(chunk_of(0, 54))}};
  pool.show(shown);
  const auto viewport = Viewport::create(loader(), extent_, pool, {&look, 1});
  ASSERT_TRUE(viewport);
  const Image before = draw(**viewport, look);
  const std::uint32_t version = pool.store().buffers_version;
  std::vector<ChunkSlot> others;
  while (pool.store().buffers_version < version + 2) others.push_back(*pool.add(chunk_of(0, 54)));
  const Image after = draw(**viewport, look);
  for (const char* const channel : {"R", "G", "B", "A"})
    EXPECT_EQ(test::values(after, channel), test::values(before, channel)) << channel;
}

/// The pool's budget holds for files with some wide patches among many narrow ones.
TEST_F(Pools, TakeWidePatchesWithoutGrowing) {
  const RenderSettings look = looks_at(model_).front();
  PatchPool pool = make_pool(look);
  const MapBytes room{0.0, 32e6, 0.0, 8e6};
  for (int k = 0; k < 4; ++k) ASSERT_TRUE(pool.reserve(room));
  model_ = test::height_field(1500, [](double x, double y) { return 0.01 * x * y; });
  extent_ = without_patches(model_);
  needs_.colours = false;
  const PatchChunk wide = chunk_of(0, 1, 2);
  ASSERT_EQ(wide.maps.normals->width, 3 * kBandWidth) << "whole columns";
  ASSERT_TRUE(pool.has_room(wide));
  const std::uint64_t before = pool.bytes();
  const auto slot = pool.add(wide);
  ASSERT_TRUE(slot) << slot.error().message;
  // What is the chunk's own comes on top: cells.
  EXPECT_LT(pool.bytes(), before + 4'000'000U);
  pool.remove(*slot);
  EXPECT_TRUE(pool.has_room(wide));
}

TEST_F(Pools, LeaveOutWhatIsHiddenAndWhatIsNotShown) {
  const RenderSettings look = looks_at(model_).front();
  PatchPool pool = make_pool(look);
  const ChunkSlot first = *pool.add(chunk_of(0, 27));
  const ChunkSlot second = *pool.add(chunk_of(27, 27));
  const auto covered = [&](const std::vector<ShownChunk>& shown) {
    pool.show(shown);
    const Image image = draw(pool, look);
    const std::vector<float>& alpha = test::values(image, "A");
    return std::count_if(alpha.begin(), alpha.end(), [](float a) { return a > 0.0F; });
  };
  EXPECT_EQ(covered({}), 0);
  const std::vector<bool> all(27, true);
  EXPECT_EQ(covered({{first, all}, {second, all}}), 0);
  const auto whole = covered({{first}, {second}});
  const auto half = covered({{first}});
  EXPECT_GT(half, 0);
  EXPECT_LT(half, whole);
  std::vector<bool> all_but_one(27, true);
  all_but_one[0] = false;
  EXPECT_LT(covered({{first, all_but_one}}), half);
}

TEST_F(Pools, ShowTheLevelsThatAreThere) {
  RenderSettings look = looks_at(model_).front();
  look.pixels_per_sample = 40.0;  // the sphere's samples are four to seven pixels apart
  PatchPool pool = make_pool(look);
  const PatchChunk coarse = chunk_of(0, 54, 2);
  EXPECT_EQ(coarse.finest, 2U);
  EXPECT_LT(coarse.bytes(), chunk_of(0, 54).bytes());
  pool.show(std::vector<ShownChunk>{{*pool.add(coarse)}});
  expect_same(draw(pool, look), draw_whole(look), "two levels are not needed");
}

TEST_F(Pools, KeepWhatMeetsAtSeams) {
  model_.joined = {{0, 54, false}};
  const RenderSettings look = looks_at(model_).front();
  PatchPool pool = make_pool(look);
  // Programs are made before there are seams, and anew once there are.
  std::vector<ShownChunk> shown;
  pool.show(shown);
  const auto viewport = Viewport::create(loader(), extent_, pool, {&look, 1});
  ASSERT_TRUE(viewport);
  static_cast<void>(draw(**viewport, look));
  const ChunkSlot away = *pool.add(chunk_of(0, 54));
  shown.push_back({*pool.add(chunk_of(0, 54, 2))});
  pool.remove(away);
  shown.front().hidden = std::vector<bool>(54, true);  // what meets others is never left out
  pool.show(shown);
  EXPECT_FALSE(pool.store().seams->seams.empty());
  expect_same(draw(**viewport, look), draw_whole(look), "joined");
}

}  // namespace
}  // namespace relief
