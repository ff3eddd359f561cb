// What the bench draws beside the engines, and what it reports. No test looks at how long it took.
#include "renderer/bench/bench.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "renderer/bench/mesh_pass.h"
#include "renderer/bench/shading_bound.h"
#include "renderer/geometry/splats_of_samples.h"
#include "renderer/render.h"
#include "renderer/store/maps/atlas.h"
#include "renderer/view/draw_list.h"
#include "tests/renderer/meshes.h"

namespace relief {
namespace {

using test::small_image;
using test::values;

RenderSettings bench_image(const PatchModel& model) {
  RenderSettings settings = small_image(model);
  settings.background.reset();
  settings.debug = true;
  settings.primitive = Primitive::Quad;
  return settings;
}

/// Quads of both interpolations, cells, and two of multipass.
std::vector<BenchMethod> some_rows(const PatchModel& model) {
  std::vector<BenchMethod> rows(5, {RenderModel::of(model), bench_image(model)});
  rows[0].settings.interpolation = Interpolation::Direct;
  rows[2].settings.primitive = Primitive::Cell;
  rows[3].settings.engine = rows[4].settings.engine = "multipass";
  rows[3].settings.multipass.radius_factor = 1.0;
  return rows;
}

test::SphereShape sphere() {
  test::SphereShape shape;
  shape.spacing = 0.1;
  return shape;
}

BenchReport must_bench(const BenchJob& job) {
  Progress silent;
  const auto report = bench(job, silent);
  EXPECT_TRUE(report) << report.error().message;
  return report ? *report : BenchReport{};
}

RenderResult must_draw(const Result<std::unique_ptr<GlPreparedModel>>& prepared,
                       const RenderSettings& settings) {
  EXPECT_TRUE(prepared);
  if (!prepared) return {};
  Progress silent;
  auto result = (*prepared)->render(settings, silent);
  EXPECT_TRUE(result) << result.error().message;
  return result ? *result : RenderResult{};
}

Result<std::shared_ptr<const OpenGl>> open_debug() {
  return OpenGl::create(GlPlatform::Automatic, true, false);
}

TEST(Bench, ReportsEachRowAndWhatBoundsIt) {
  const PatchModel model = test::sphere_model(sphere());
  const TriangleMesh mesh = test::sphere_mesh(64);
  const BenchJob job{some_rows(model), &mesh, 1, 2, 1};
  const BenchReport report = must_bench(job);
  ASSERT_EQ(report.rows.size(), job.rows.size());
  ASSERT_TRUE(report.shading_bound);
  ASSERT_TRUE(report.mesh);
  for (std::size_t k = 0; k < job.rows.size(); ++k) {
    // As the image alone, whatever is drawn beside it.
    const RenderResult alone = test::must_render(model, job.rows[k].settings);
    EXPECT_EQ(report.rows[k].covered_pixels, alone.covered_pixels) << k;
    EXPECT_EQ(report.rows[k].fragments, alone.fragments) << k;
    EXPECT_GT(report.rows[k].time.frame_ms, 0.0) << k;
  }
  EXPECT_EQ(report.shading_bound->covered_pixels, report.rows[1].covered_pixels);
  EXPECT_EQ(report.shading_bound->fragments, report.rows[1].covered_pixels);  // no overdraw
}

TEST(Bench, CountsTheBytesOfEachRowSeparately) {
  constexpr std::uint32_t kNodes = 12;
  const PatchModel model = test::height_field(kNodes, [](double, double) { return 0.0; });
  const BenchJob job{some_rows(model), nullptr, 1, 1, 0};
  const BenchReport report = must_bench(job);
  ASSERT_EQ(report.rows.size(), 5U);
  // Corrected interpolation reads a height map, two bytes a node and a ring beyond the last; cells
  // have no records and no such map.
  const auto map = pack_atlas({{kNodes + 1, kNodes + 1}}, 16384, 1);
  ASSERT_TRUE(map);
  for (const BenchRow& row : report.rows) ASSERT_TRUE(row.model_bytes && row.gpu_bytes);
  EXPECT_EQ(*report.rows[1].model_bytes - *report.rows[0].model_bytes,
            std::uint64_t{2} * map->size.x * map->size.y);
  EXPECT_LT(*report.rows[2].model_bytes, *report.rows[0].model_bytes);
  // Multipass has the same model, drawn by a smaller command, sums of normals, RGBA16F, and the
  // side that is seen: R8UI.
  const std::uint64_t commands = sizeof(ElementsCommand) - sizeof(ArraysCommand);
  const std::uint64_t pixels =
      std::uint64_t{job.rows[0].settings.width} * job.rows[0].settings.height;
  EXPECT_EQ(*report.rows[3].model_bytes + commands, *report.rows[0].model_bytes);
  EXPECT_EQ(*report.rows[3].gpu_bytes + commands, *report.rows[0].gpu_bytes + (8 + 1) * pixels);
  EXPECT_EQ(*report.rows[0].gpu_bytes - *report.rows[0].model_bytes, (8 + 4) * pixels);
  EXPECT_FALSE(report.mesh);  // there is none
}

TEST(Bench, DrawsSeveralModels) {
  const PatchModel coarse = test::sphere_model(sphere());
  test::SphereShape shape = sphere();
  shape.spacing = 0.05;
  const PatchModel fine = test::sphere_model(shape);
  const RenderSettings settings = bench_image(coarse);
  const BenchJob job{
      {{RenderModel::of(coarse), settings}, {RenderModel::of(fine), settings}}, nullptr, 0, 1, 0};
  const BenchReport report = must_bench(job);
  ASSERT_EQ(report.rows.size(), 2U);
  EXPECT_EQ(report.rows[0].fragments, test::must_render(coarse, settings).fragments);
  EXPECT_EQ(report.rows[1].fragments, test::must_render(fine, settings).fragments);
  EXPECT_GT(*report.rows[1].model_bytes, *report.rows[0].model_bytes);
}

TEST(Bench, TimesRowsOnTheCpuBesideThoseOnOpenGl) {
  const PatchModel model = test::sphere_model(sphere());
  test::SphereShape shape = sphere();
  shape.spacing = 0.2;
  const SplatCloud points = splats_of_samples(test::sphere_model(shape));
  RenderModel both = RenderModel::of(model);
  both.add(points);
  const RenderSettings drawn = bench_image(model);
  RenderSettings splatted = drawn;
  splatted.engine = "ewa";
  // Between rows on OpenGL, of samples and of points.
  const BenchJob job{{{RenderModel::of(model), splatted},
                      {RenderModel::of(model), drawn},
                      {both, splatted},
                      {both, drawn}},
                     nullptr,
                     1,
                     kMostCpuFrames + 2,
                     1};
  const BenchReport report = must_bench(job);
  ASSERT_EQ(report.rows.size(), 4U);
  for (const std::size_t k : {0U, 2U}) {
    const BenchRow& row = report.rows[k];
    // 64 x 48 pixels take milliseconds: as many frames as there can be.
    EXPECT_EQ(row.time.frames, kMostCpuFrames) << k;
    EXPECT_GT(row.time.frame_ms, 0.0) << k;
    EXPECT_FALSE(row.time.gpu_ms) << k;
    EXPECT_FALSE(row.gpu_bytes) << k;
    EXPECT_FALSE(row.model_bytes) << k;
  }
  for (const std::size_t k : {1U, 3U}) EXPECT_EQ(report.rows[k].time.frames, job.frames) << k;
  Progress silent;
  const auto samples = render(model, splatted, silent);
  const auto cloud = render(points, splatted, silent);
  ASSERT_TRUE(samples && cloud);
  EXPECT_EQ(report.rows[0].fragments, samples->fragments);
  EXPECT_EQ(report.rows[2].fragments, cloud->fragments) << "points, where a model has some";
  EXPECT_NE(samples->fragments, cloud->fragments);
  EXPECT_EQ(report.rows[0].covered_pixels, samples->covered_pixels);
  EXPECT_EQ(report.rows[3].fragments, report.rows[1].fragments);
  ASSERT_TRUE(report.shading_bound);
  EXPECT_EQ(report.shading_bound->covered_pixels, report.rows[1].covered_pixels);
}

TEST(Bench, NeedsNoOpenGlForRowsOnTheCpu) {
  const PatchModel model = test::sphere_model(sphere());
  const TriangleMesh mesh = test::sphere_mesh(16);
  RenderSettings splatted = bench_image(model);
  splatted.engine = "ewa";
  const BenchReport report =
      must_bench({{{RenderModel::of(model), splatted}}, &mesh, std::nullopt, 1, 0});
  ASSERT_EQ(report.rows.size(), 1U);
  EXPECT_EQ(report.renderer, "CPU");
  EXPECT_EQ(report.rows[0].time.frames, 1) << "no more than are asked for";
  EXPECT_FALSE(report.shading_bound);
  EXPECT_FALSE(report.mesh);
}

TEST(Bench, HasNoBoundOfAnEmptyImage) {
  const PatchModel model = test::sphere_model(sphere());
  BenchJob job{some_rows(model), nullptr, 0, 1, 0};
  for (BenchMethod& row : job.rows)
    row.settings.camera.target = 2.0 * row.settings.camera.eye;  // looks away
  const BenchReport report = must_bench(job);
  EXPECT_EQ(report.rows[0].covered_pixels, 0U);
  EXPECT_FALSE(report.shading_bound);
}

TEST(Bench, CanBeInterrupted) {
  class Stopped final : public Progress {
   public:
    [[nodiscard]] bool cancelled() const override { return true; }
  } stopped;
  const PatchModel model = test::sphere_model(sphere());
  EXPECT_FALSE(bench({some_rows(model), nullptr, 0, 1, 0}, stopped));
}

TEST(ShadingBound, ShadesTheRequestedNumberOfPixels) {
  const PatchModel model = test::sphere_model(sphere());
  for (const Material material : {Material::Unlit, Material::Lit, Material::Mirror}) {
    RenderSettings settings = bench_image(model);
    settings.material = material;
    const std::uint64_t all = std::uint64_t{settings.width} * settings.height;
    for (const std::uint64_t pixels : {std::uint64_t{1000}, all}) {
      const auto opengl = open_debug();
      ASSERT_TRUE(opengl);
      const RenderResult drawn = must_draw(
          bench_passes::prepare_shading_bound(*opengl, model, settings, pixels), settings);
      EXPECT_EQ(drawn.covered_pixels, pixels);
      EXPECT_EQ(drawn.fragments, pixels);
      for (const float red : values(drawn.image, "R")) ASSERT_TRUE(std::isfinite(red));
    }
  }
}

TEST(ShadingBound, LooksUpTheMapsOfThePatch) {
  test::SphereShape shape = sphere();
  shape.coloured = true;
  const PatchModel model = test::sphere_model(shape);
  RenderSettings settings = bench_image(model);
  settings.material = Material::Unlit;
  const auto opengl = open_debug();
  ASSERT_TRUE(opengl);
  const RenderResult drawn =
      must_draw(bench_passes::prepare_shading_bound(*opengl, model, settings, 2000), settings);
  const auto& red = values(drawn.image, "R");
  const auto [least, most] = std::minmax_element(red.begin(), red.end());
  EXPECT_LT(*least, *most);  // looks up different texels
}

// The mesh pass against the ray tracer: the same triangles and normals, one sample a pixel.
TEST(MeshPass, DrawsTheMesh) {
  const PatchModel model = test::sphere_model(sphere());
  const TriangleMesh mesh = test::sphere_mesh(64);
  for (const Material material : {Material::Unlit, Material::Lit}) {
    RenderSettings settings = bench_image(model);
    settings.material = material;
    const auto opengl = open_debug();
    ASSERT_TRUE(opengl);
    const RenderResult drawn =
        must_draw(bench_passes::prepare_mesh(*opengl, mesh, settings), settings);
    settings.raytrace.samples = 1;
    const RenderResult truth = test::must_trace(mesh, settings);
    // Pixels whose middle is within 1/256 pixel of the silhouette (OpenGL snaps corners to that)
    // may fall on either side: of some 400 on the rim, two.
    EXPECT_LE(test::count_different(drawn.image, truth.image, 2), 4U);
    EXPECT_GT(drawn.covered_pixels, 1000U);
  }
}

TEST(MeshPass, HasColoursWhereTheMeshHas) {
  const PatchModel model = test::height_field(8, [](double, double) { return 0.0; });
  TriangleMesh mesh;
  test::add_sheet(mesh, {-2.0, -2.0, 0.0}, {4.0, 0.0, 0.0}, {0.0, 4.0, 0.0},
                  {0.25F, 0.5F, 0.75F, 1.0F});
  RenderSettings settings = test::from_above(model, 8);
  settings.background.reset();
  settings.material = Material::Unlit;
  const auto opengl = open_debug();
  ASSERT_TRUE(opengl);
  const RenderResult drawn =
      must_draw(bench_passes::prepare_mesh(*opengl, mesh, settings), settings);
  const std::size_t middle =
      (std::size_t{settings.height} / 2) * settings.width + settings.width / 2;
  // Exact in half floats.
  const float rounding = test::colour_rounding(drawn);
  EXPECT_NEAR(values(drawn.image, "R")[middle], 0.25F, rounding);
  EXPECT_NEAR(values(drawn.image, "G")[middle], 0.5F, rounding);
  EXPECT_NEAR(values(drawn.image, "B")[middle], 0.75F, rounding);
}

}  // namespace
}  // namespace relief
