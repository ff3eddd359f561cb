// A window's way to draw: in a context that the test owns, into the test's own framebuffer.
#include "renderer/viewport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

#include "renderer/engine_registry.h"
#include "renderer/frame/targets/attachments.h"
#include "renderer/frame/targets/targets.h"
#include "renderer/gl/open_gl.h"
#include "renderer/shading/environment/environment_cache.h"
#include "renderer/store/collected_store.h"
#include "tests/renderer/gl/own_context.h"
#include "tests/renderer/images.h"
#include "tests/renderer/scenes.h"

namespace relief {
namespace {

PatchModel viewport_model() {
  test::SphereShape shape;
  shape.bumps = 0.1;
  shape.patches_per_side = 2;
  shape.coloured = true;
  return test::sphere_model(shape);
}

/// From three sides, at two sizes and three levels of detail, the last from so far that the model
/// is small.
std::vector<RenderSettings> views_around(const PatchModel& model) {
  std::vector<RenderSettings> views;
  for (const std::uint32_t side : {64U, 96U}) {
    views.push_back(test::small_image(model, {20.0, 15.0}, side));
    views.back().pixels_per_sample = 0.0;
    views.push_back(test::small_image(model, {140.0, -40.0}, side));
    views.back().pixels_per_sample = 6.0;
    views.push_back(test::small_image(model, {250.0, 60.0, 20.0}, side));
  }
  for (RenderSettings& view : views) view.background = std::nullopt;
  return views;
}

/// A window, without the window.
using Window = test::OwnContext;

struct WindowFramebuffer {
  WindowFramebuffer(const Gl& gl, std::uint32_t width, std::uint32_t height)
      : colour(make_attachment(gl, "window", GL_RGBA16F, width, height)),
        framebuffer(make_framebuffer(gl, "window", nullptr, {{0, &colour}})) {}
  Texture colour;
  Framebuffer framebuffer;
};

/// What render() gives for these views, of a model that is on the GPU with all its levels.
std::vector<Image> render_with_all_levels(const PatchModel& patches,
                                          std::span<const RenderSettings> views) {
  const RenderModel model = RenderModel::of(patches);
  const auto opengl = OpenGl::create(GlPlatform::Automatic, false, false);
  EXPECT_TRUE(opengl);
  const auto prepared = find_engine(views.front().engine)
                            ->prepare({.model = model,
                                       .views = views,
                                       .opengl = *opengl,
                                       .environments = std::make_shared<EnvironmentCache>(),
                                       .levels = KeptLevels::All});
  EXPECT_TRUE(prepared);
  Progress silent;
  std::vector<Image> images;
  for (const RenderSettings& view : views) {
    auto result = (*prepared)->render(view, silent);
    EXPECT_TRUE(result);
    images.push_back(std::move(result->image));
  }
  return images;
}

TEST(Viewport, DrawsWhatRenderDoesFromAnyViewAtAnySize) {
  const PatchModel model = viewport_model();
  for (const char* const engine : {"onepass", "multipass"}) {
    std::vector<RenderSettings> views = views_around(model);
    for (RenderSettings& view : views) view.engine = engine;
    const std::vector<Image> expected = render_with_all_levels(model, views);
    const Window window;
    const auto viewport =
        Viewport::create(window.loader(), RenderModel::of(model), {views.data() + 2, 1});
    ASSERT_TRUE(viewport) << viewport.error().message;
    for (std::size_t k = 0; k < views.size(); ++k) {
      const WindowFramebuffer into(window.gl(), views[k].width, views[k].height);
      const Status drawn = (*viewport)->draw(views[k], into.framebuffer.id());
      ASSERT_TRUE(drawn) << drawn.error().message;
      const Image image = read_colour(window.gl(), into.colour, views[k].width, views[k].height);
      for (const char* const channel : {"R", "G", "B", "A"})
        EXPECT_EQ(test::values(image, channel), test::values(expected[k], channel))
            << engine << " view " << k << " " << channel;
    }
  }
}

TEST(Viewport, DrawsTheSameOfWhatWasCollectedOnAnotherThread) {
  const PatchModel model = viewport_model();
  const RenderModel form = RenderModel::of(model);
  RenderSettings lit = views_around(model)[1];
  RenderSettings unlit = lit;
  unlit.material = Material::Unlit;
  // The last was collected for a look that needs no normals: it is left aside.
  for (const RenderSettings& collected_for : {lit, unlit}) {
    const Window window;
    Result<std::unique_ptr<CollectedStore>> collected = std::unique_ptr<CollectedStore>();
    std::thread([&, limits = store_limits(window.gl())] {
      collected = collect_for_viewport(form, {&collected_for, 1}, limits);
    }).join();
    ASSERT_TRUE(collected) << collected.error().message;
    ASSERT_NE(*collected, nullptr);
    const auto viewport =
        Viewport::create(window.loader(), form, {&lit, 1}, engines(), collected->get());
    ASSERT_TRUE(viewport) << viewport.error().message;
    const WindowFramebuffer into(window.gl(), lit.width, lit.height);
    ASSERT_TRUE((*viewport)->draw(lit, into.framebuffer.id()));
    const Image image = read_colour(window.gl(), into.colour, lit.width, lit.height);
    const Image expected = render_with_all_levels(model, {&lit, 1}).front();
    for (const char* const channel : {"R", "G", "B", "A"})
      EXPECT_EQ(test::values(image, channel), test::values(expected, channel)) << channel;
  }
}

// A look may be set beside another engine's while its model is collected: what was collected is
// used up by one of them.
TEST(Viewport, DrawsTwoEnginesOfWhatWasCollectedForOne) {
  const PatchModel model = viewport_model();
  const RenderModel form = RenderModel::of(model);
  std::vector<RenderSettings> looks(2, views_around(model)[0]);
  looks[0].primitive = looks[1].primitive = Primitive::Quad;
  looks[0].interpolation = Interpolation::Direct;  // needs as much as the other
  looks[1].engine = "multipass";
  std::vector<Image> expected;
  for (const RenderSettings& look : looks)
    expected.push_back(render_with_all_levels(model, {&look, 1}).front());
  const Window window;
  const auto collected = collect_for_viewport(form, {looks.data(), 1}, store_limits(window.gl()));
  ASSERT_TRUE(collected) << collected.error().message;
  const auto viewport = Viewport::create(window.loader(), form, looks, engines(), collected->get());
  ASSERT_TRUE(viewport) << viewport.error().message;
  for (std::size_t k = 0; k < looks.size(); ++k) {
    const WindowFramebuffer into(window.gl(), looks[k].width, looks[k].height);
    ASSERT_TRUE((*viewport)->draw(looks[k], into.framebuffer.id()));
    const Image image = read_colour(window.gl(), into.colour, looks[k].width, looks[k].height);
    for (const char* const channel : {"R", "G", "B", "A"})
      EXPECT_EQ(test::values(image, channel), test::values(expected[k], channel)) << k << channel;
  }
}

TEST(CollectedStore, ServesOrdersOfWhichTheSameIsMade) {
  const PatchModel model = viewport_model();
  const Window window;
  StoreOrder order{{.cells = true}, std::vector<View>(1), true};
  const auto collected = CollectedStore::collect(store_limits(window.gl()), model, order);
  ASSERT_TRUE(collected);
  const auto serves = [&](const auto& change) {
    StoreOrder other = order;
    change(other);
    return (*collected)->serves(other);
  };
  EXPECT_TRUE(serves([](StoreOrder& o) { o.views.front().eye = {1.0, 2.0, 3.0}; }));
  EXPECT_FALSE(serves([](StoreOrder& o) { o.needs.normals = true; }));
  EXPECT_FALSE(serves([](StoreOrder& o) { o.views.front().proxy_diameter = 128.0; }));
  EXPECT_FALSE(serves([](StoreOrder& o) { o.views.front().cull = CullMode::Auto; }));
  EXPECT_FALSE(serves([](StoreOrder& o) { o.all_levels = false; }));
}

TEST(Viewport, CollectsNothingForSeveralEnginesAndStopsWhenAsked) {
  const PatchModel model = viewport_model();
  const RenderModel form = RenderModel::of(model);
  std::vector<RenderSettings> looks(2, views_around(model)[1]);
  looks[1].engine = "multipass";
  const Window window;
  const StoreLimits limits = store_limits(window.gl());
  const auto none = collect_for_viewport(form, looks, limits);
  ASSERT_TRUE(none);
  EXPECT_EQ(*none, nullptr);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_FALSE(collect_for_viewport(form, {looks.data(), 1}, limits, stop.get_token()));
}

// A wipe draws one look left of its divider and another right of it; a picture that is refined is
// drawn in bands.
TEST(Viewport, DrawsPartsThatAreThoseOfTheWholeWithAnySamplesAPixel) {
  const PatchModel model = viewport_model();
  for (const int samples : {1, 4}) {
    RenderSettings view = views_around(model)[1];
    view.samples = samples;
    const Image expected = render_with_all_levels(model, {&view, 1}).front();
    const Window window;
    const auto viewport = Viewport::create(window.loader(), RenderModel::of(model), {&view, 1});
    ASSERT_TRUE(viewport) << viewport.error().message;
    const WindowFramebuffer whole(window.gl(), view.width, view.height);
    ASSERT_TRUE((*viewport)->draw(view, whole.framebuffer.id()));
    const WindowFramebuffer parts(window.gl(), view.width, view.height);
    const std::uint32_t cut = 23;
    ASSERT_TRUE((*viewport)->draw(view, {0, 0, cut, view.height}, parts.framebuffer.id()));
    ASSERT_TRUE(
        (*viewport)->draw(view, {cut, 0, view.width - cut, view.height}, parts.framebuffer.id()));
    const Image one = read_colour(window.gl(), whole.colour, view.width, view.height);
    const Image joined = read_colour(window.gl(), parts.colour, view.width, view.height);
    for (const char* const channel : {"R", "G", "B", "A"}) {
      EXPECT_EQ(test::values(one, channel), test::values(expected, channel)) << samples;
      const std::vector<float>& a = test::values(joined, channel);
      const std::vector<float>& b = test::values(expected, channel);
      // The part's projection is rounded otherwise: a colour by a half float's last two bits, and
      // where an edge passes through a sample, that sample.
      std::size_t edges = 0;
      for (std::size_t p = 0; p < a.size(); ++p) edges += std::abs(a[p] - b[p]) > 0x1p-10F ? 1 : 0;
      EXPECT_LE(edges, 2U) << channel << " of " << samples << " samples";
    }
  }
}

TEST(Viewport, ProbesThePixelThatOneSees) {
  const PatchModel model = viewport_model();
  RenderSettings view = views_around(model)[1];
  view.outputs.depth = true;
  view.outputs.patch_id = true;
  const Image expected = render_with_all_levels(model, {&view, 1}).front();
  view.outputs = {};
  const Window window;
  const auto viewport = Viewport::create(window.loader(), RenderModel::of(model), {&view, 1});
  ASSERT_TRUE(viewport) << viewport.error().message;
  int covered = 0;
  for (std::uint32_t y = 0; y < view.height; y += 3) {
    for (std::uint32_t x = 0; x < view.width; x += 3) {
      const auto pixel = (*viewport)->probe(view, x, y);
      ASSERT_TRUE(pixel) << pixel.error().message;
      const std::size_t at = std::size_t{view.height - 1 - y} * view.width + x;
      for (const char* const channel : {"patch", "A"})
        EXPECT_EQ(test::values(*pixel, channel)[0], test::values(expected, channel)[at])
            << channel << " " << x << "," << y;
      const float distance = test::values(expected, "Z")[at];
      if (distance < std::numeric_limits<float>::infinity()) {
        // Its triangles are a hundred times as large as the image of one pixel.
        EXPECT_NEAR(test::values(*pixel, "Z")[0], distance, 1e-5F * distance) << x << "," << y;
      }
      covered += test::values(*pixel, "A")[0] > 0.0F ? 1 : 0;
    }
  }
  EXPECT_GT(covered, 50);
}

// What a window shades by eye-dome lighting.
TEST(Viewport, CopiesTheDepthThatEyeDomeLightingNeeds) {
  const PatchModel model = viewport_model();
  for (const bool orthographic : {false, true}) {
    RenderSettings view = views_around(model)[0];
    if (orthographic) view.camera.orthographic_height = 3.0;
    view.outputs.depth = true;
    const Image expected = render_with_all_levels(model, {&view, 1}).front();
    const std::vector<float>& distances = test::values(expected, "Z");
    view.outputs = {};
    const Window window;
    const Gl& gl = window.gl();
    const auto viewport = Viewport::create(window.loader(), RenderModel::of(model), {&view, 1});
    ASSERT_TRUE(viewport) << viewport.error().message;
    const Texture colour = make_attachment(gl, "window", GL_RGBA16F, view.width, view.height);
    const Texture depth =
        make_attachment(gl, "window", GL_DEPTH_COMPONENT32F, view.width, view.height);
    const Framebuffer into = make_framebuffer(gl, "window", &depth, {{0, &colour}});
    const float before = 0.75F;
    gl.ClearNamedFramebufferfv(into.id(), GL_DEPTH, 0, &before);
    const auto drawn_depths = [&] {
      EXPECT_TRUE((*viewport)->draw(view, into.id()));
      std::vector<float> values(std::size_t{view.width} * view.height);
      gl.GetTextureImage(depth.id(), 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                         static_cast<GLsizei>(values.size() * sizeof(float)), values.data());
      return values;
    };
    for (const float value : drawn_depths()) ASSERT_EQ(value, before);
    view.eye_dome = 1.0;
    const std::vector<float> depths = drawn_depths();
    const double range = (*viewport)->depth_range(view);
    EXPECT_EQ(range > 0.0, orthographic);
    // Depth is near / Z, or falls by 1 over the range: either way one number is that of all pixels.
    std::vector<double> numbers;
    for (std::uint32_t y = 0; y < view.height; ++y) {
      for (std::uint32_t x = 0; x < view.width; ++x) {
        const double z = distances[std::size_t{view.height - 1 - y} * view.width + x];
        const double d = depths[std::size_t{y} * view.width + x];
        ASSERT_EQ(d > 0.0, std::isfinite(z)) << x << "," << y;
        if (d > 0.0) numbers.push_back(orthographic ? z + d * range : d * z);
      }
    }
    ASSERT_GT(numbers.size(), 1000U);
    std::sort(numbers.begin(), numbers.end());
    const double usual = numbers[numbers.size() / 2];
    // Both are rounded to single precision, the depth after a division.
    const auto off = std::count_if(numbers.begin(), numbers.end(), [usual](double number) {
      return std::abs(number - usual) > 2e-6 * usual;
    });
    // The splats at the borders of patches have the depth of their quads, as they are drawn, and
    // give Z of the surface: 4 to 5 % of the pixels.
    EXPECT_LT(off, 0.1 * static_cast<double>(numbers.size()));
  }
}

// A single image keeps only the levels that it draws. They lie elsewhere in the atlas of normals
// than among all levels, so that texture coordinates are rounded differently.
TEST(Viewport, KeepsAllLevelsWhichMovesCoarseOnesByARounding) {
  const PatchModel model = viewport_model();
  const std::vector<RenderSettings> views = views_around(model);
  const std::vector<Image> all = render_with_all_levels(model, views);
  for (std::size_t k = 0; k < views.size(); ++k) {
    const Image one = test::must_render(model, views[k]).image;
    EXPECT_EQ(test::values(all[k], "A"), test::values(one, "A")) << k;
    // Half floats below 1 are 2^-11 apart; only the second and fifth view draw coarser levels.
    const float max = k % 3 == 1 ? 0x1p-11F : 0.0F;
    for (const char* const channel : {"R", "G", "B"}) {
      const std::vector<float>& a = test::values(all[k], channel);
      const std::vector<float>& b = test::values(one, channel);
      for (std::size_t p = 0; p < a.size(); ++p) ASSERT_NEAR(a[p], b[p], max) << k << " " << p;
    }
  }
}

TEST(Viewport, LeavesTheStateOfOpenGlAsItWas) {
  const PatchModel model = viewport_model();
  const RenderSettings view = views_around(model).front();
  const Window window;
  const Gl& gl = window.gl();
  const WindowFramebuffer into(gl, view.width, view.height);
  const WindowFramebuffer other(gl, 8, 8);
  const VertexArray vertices(gl, "window's");
  const auto set = [&] {
    gl.BindFramebuffer(GL_FRAMEBUFFER, other.framebuffer.id());
    gl.BindVertexArray(vertices.id());
    gl.Viewport(1, 2, 3, 4);
    gl.Enable(GL_SCISSOR_TEST);
    gl.Enable(GL_BLEND);
    gl.Enable(GL_CULL_FACE);
    gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_DST_ALPHA);
    gl.DepthFunc(GL_LEQUAL);
    gl.DepthMask(GL_FALSE);
    gl.CullFace(GL_FRONT);
    gl.FrontFace(GL_CW);
    gl.ClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
    gl.ColorMask(GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE);
  };
  const auto state = [&] {
    std::vector<GLint> all;
    for (const GLenum name : {GL_DRAW_FRAMEBUFFER_BINDING,
                              GL_READ_FRAMEBUFFER_BINDING,
                              GL_VERTEX_ARRAY_BINDING,
                              GL_CURRENT_PROGRAM,
                              GL_DRAW_INDIRECT_BUFFER_BINDING,
                              GL_SCISSOR_TEST,
                              GL_BLEND,
                              GL_CULL_FACE,
                              GL_DEPTH_TEST,
                              GL_PROGRAM_POINT_SIZE,
                              GL_TEXTURE_CUBE_MAP_SEAMLESS,
                              GL_BLEND_SRC_RGB,
                              GL_BLEND_DST_RGB,
                              GL_BLEND_SRC_ALPHA,
                              GL_BLEND_DST_ALPHA,
                              GL_DEPTH_FUNC,
                              GL_DEPTH_WRITEMASK,
                              GL_CULL_FACE_MODE,
                              GL_FRONT_FACE,
                              GL_CLIP_ORIGIN,
                              GL_CLIP_DEPTH_MODE})
      all.push_back(get_limit(gl, name));
    std::array<GLint, 4> four{};
    gl.GetIntegerv(GL_VIEWPORT, four.data());
    all.insert(all.end(), four.begin(), four.end());
    gl.GetIntegerv(GL_COLOR_WRITEMASK, four.data());
    all.insert(all.end(), four.begin(), four.end());
    return all;
  };
  set();
  const std::vector<GLint> before = state();
  const auto viewport = Viewport::create(window.loader(), RenderModel::of(model), {&view, 1});
  ASSERT_TRUE(viewport) << viewport.error().message;
  EXPECT_EQ(state(), before);
  ASSERT_TRUE((*viewport)->draw(view, into.framebuffer.id()));
  EXPECT_EQ(state(), before);
  const Image image = read_colour(gl, into.colour, view.width, view.height);
  const std::vector<float>& alpha = test::values(image, "A");
  EXPECT_GT(std::count(alpha.begin(), alpha.end(), 1.0F), 500);
}

TEST(Viewport, RefusesWhatItCannotDraw) {
  const PatchModel model = viewport_model();
  RenderSettings view = views_around(model).front();
  const Window window;
  view.engine = "ewa";
  const auto refused = Viewport::create(window.loader(), RenderModel::of(model), {&view, 1});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message,
            "engine ewa does not draw with OpenGL, which a viewport needs");
  view.engine = "onepass";
  const auto viewport = Viewport::create(window.loader(), RenderModel::of(model), {&view, 1});
  ASSERT_TRUE(viewport);
  view.engine = "multipass";
  EXPECT_FALSE((*viewport)->draw(view, 0));
}

}  // namespace
}  // namespace relief
