// The hierarchy of spheres over surfels, and what of it is drawn.
#include "renderer/surfels/sphere_tree.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <limits>

#include "tests/renderer/surfels/sampled_surfaces.h"

namespace relief {
namespace {

struct SurfelScene {
  test::SampledSurface surface;
  std::vector<double> reaches;
  SphereTree tree;

  explicit SurfelScene(test::SampledSurface sampled, double reach = 0.03)
      : surface(std::move(sampled)), reaches(surface.positions.size(), reach) {
    Progress progress;
    auto built = build_sphere_tree(
        {surface.positions, surface.normals, reaches, std::span<const float>()}, progress);
    EXPECT_TRUE(built);
    if (built) tree = std::move(*built);
  }
};

SurfelScene torus_scene(std::size_t points) {
  return SurfelScene(test::sample_surface(test::Shape::Torus, test::Sampling::Random, points, 7));
}

Camera camera_at(glm::dvec3 eye, glm::dvec3 target) {
  Camera camera;
  camera.eye = eye;
  camera.target = target;
  camera.vertical_fov_degrees = 40.0;
  return camera;
}

/// How often each surfel is in the cut, itself or in a mean.
std::vector<int> uses(const SphereTree& tree, const SphereCut& cut) {
  std::vector<int> of_surfel(tree.order.size());
  const auto use = [&](std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t slot = first; slot < first + count; ++slot) ++of_surfel[tree.order[slot]];
  };
  for (const SurfelRun& run : cut.surfels) use(run.first, run.count);
  for (const SurfelRun& run : cut.nodes) {
    for (std::uint32_t n = run.first; n < run.first + run.count; ++n)
      use(tree.nodes[n].first, tree.nodes[n].count);
  }
  return of_surfel;
}

void expect_ascending(const std::vector<SurfelRun>& runs) {
  for (std::size_t k = 1; k < runs.size(); ++k)
    EXPECT_LT(runs[k - 1].first + runs[k - 1].count, runs[k].first) << "apart, so that they count";
}

TEST(SphereTree, HoldsSurfelsAndNormals) {
  const SurfelScene scene = torus_scene(5000);
  const SphereTree& tree = scene.tree;
  std::vector<std::uint32_t> order = tree.order;
  std::ranges::sort(order);
  for (std::uint32_t k = 0; k < order.size(); ++k) ASSERT_EQ(order[k], k);
  std::size_t parents = 0;
  for (const SphereNode& node : tree.nodes) {
    for (std::uint32_t slot = node.first; slot < node.first + node.count; ++slot) {
      const std::uint32_t k = tree.order[slot];
      const glm::dvec3 p = scene.surface.positions[k];
      // Rounding, of numbers about 1.
      EXPECT_LE(glm::distance(p, node.centre) + scene.reaches[k], node.radius + 1e-12);
      EXPECT_GE(glm::dot(scene.surface.normals[k], node.axis), node.cos_angle);
      const glm::dvec3 d = p - node.mean;
      const double across =
          glm::length(d - glm::dvec3(node.axis) * glm::dot(d, glm::dvec3(node.axis)));
      EXPECT_LE(across + scene.reaches[k], node.mean_radius + 1e-12);
    }
    if (node.children == 0) {
      EXPECT_LE(node.count, SphereTree::kLeafSize);
      continue;
    }
    ++parents;
    EXPECT_GE(node.children, 2U);
    EXPECT_LE(node.children, 4U);
    std::uint32_t first = node.first;
    for (std::uint32_t c = node.child; c < node.child + node.children; ++c) {
      EXPECT_EQ(tree.nodes[c].first, first);
      first += tree.nodes[c].count;
    }
    EXPECT_EQ(first, node.first + node.count);
  }
  // Halves of a node that are small enough for a leaf are not divided again, so that nodes above
  // leaves have two children.
  EXPECT_GT(static_cast<double>(tree.nodes.size() - 1) / static_cast<double>(parents), 2.8);
}

TEST(SphereTree, CutsLeaveOutOnlyWhatIsNotSeen) {
  const SurfelScene scene = torus_scene(20000);
  for (const bool orthographic : {false, true}) {
    Camera camera = camera_at({1.5, -2.0, 1.0}, {0.9, 0.1, 0.0});
    if (orthographic) camera.orthographic_height = 1.2;
    const View view = make_view(camera, 320, 240, 0.01);
    for (const std::uint32_t fewest : {1U, 64U}) {
      const SphereCut cut = cut_sphere_tree(scene.tree, view, {.fewest = fewest});
      expect_ascending(cut.surfels);
      EXPECT_TRUE(cut.nodes.empty());
      const std::vector<int> drawn = uses(scene.tree, cut);
      std::uint64_t left_out = 0;
      for (std::size_t k = 0; k < drawn.size(); ++k) {
        ASSERT_LE(drawn[k], 1);
        if (drawn[k] == 1) continue;
        ++left_out;
        const glm::dvec3 p = scene.surface.positions[k];
        const glm::dvec3 forward = -glm::transpose(view.rotation)[2];
        const glm::dvec3 to_surfel = orthographic ? forward : p - view.eye;
        const bool is_back = glm::dot(glm::dvec3(scene.surface.normals[k]), to_surfel) > 0.0;
        EXPECT_TRUE(is_back || !sees_sphere(view, p, scene.reaches[k]));
      }
      EXPECT_EQ(left_out, cut.outside + cut.facing_away);
      EXPECT_GT(cut.outside, 2000U) << "a part of the torus is beside the image";
      EXPECT_GT(cut.facing_away, 2000U);
    }
    const SphereCut all = cut_sphere_tree(scene.tree, view, {.frustum = false, .backs = false});
    ASSERT_EQ(all.surfels.size(), 1U) << "one run";
    EXPECT_EQ(all.surfels[0].count, 20000U);
  }
}

TEST(SphereTree, MeansStandForSmallNodes) {
  const SurfelScene scene = torus_scene(20000);
  const Camera camera = camera_at({0, -20, 5}, {0, 0, 0});
  const View view = make_view(camera, 200, 200, 0.01);
  std::uint64_t before = 20001;
  for (const double pixels : {1.0, 4.0, 16.0}) {
    const SphereCut cut =
        cut_sphere_tree(scene.tree, view, {.frustum = false, .backs = false, .pixels = pixels});
    expect_ascending(cut.nodes);
    for (const int count : uses(scene.tree, cut)) ASSERT_EQ(count, 1) << "each exactly once";
    std::uint64_t drawn = 0;
    for (const SurfelRun& run : cut.surfels) drawn += run.count;
    for (const SurfelRun& run : cut.nodes) {
      drawn += run.count;
      for (std::uint32_t n = run.first; n < run.first + run.count; ++n) {
        const SphereNode& node = scene.tree.nodes[n];
        EXPECT_LE(2.0 * node.mean_radius, pixels * nearest_pixel(view, node.centre, node.radius));
        EXPECT_GT(node.cos_angle, 0.0F);
      }
    }
    EXPECT_LT(drawn, before) << pixels;
    before = drawn;
  }
  EXPECT_LT(before, 2000U);
}

TEST(SphereTree, NearViewsAreNotDividedInSearchOfMeans) {
  const SurfelScene scene = torus_scene(20000);
  const View view = make_view(camera_at({1.5, -2.0, 1.0}, {0.9, 0.1, 0.0}), 320, 240, 0.01);
  // Pixels are some 0.003 wide, and the discs of single surfels 0.06.
  const SphereCut none = cut_sphere_tree(scene.tree, view, {});
  const SphereCut near = cut_sphere_tree(scene.tree, view, {.pixels = 1.0});
  EXPECT_TRUE(near.nodes.empty());
  EXPECT_EQ(near.visited, none.visited);
  EXPECT_EQ(uses(scene.tree, near), uses(scene.tree, none));
}

TEST(SphereTree, WiderConesOfBentSurfelsAreCulledLater) {
  SurfelScene scene = torus_scene(5000);
  const std::vector<float> spreads(5000, 0.5F);
  Progress progress;
  const auto bent = build_sphere_tree(
      {scene.surface.positions, scene.surface.normals, scene.reaches, spreads}, progress);
  ASSERT_TRUE(bent);
  const View view = make_view(camera_at({0, -4, 1}, {0, 0, 0}), 200, 200, 0.01);
  EXPECT_LT(cut_sphere_tree(*bent, view, {}).facing_away,
            cut_sphere_tree(scene.tree, view, {}).facing_away);
  for (std::size_t n = 0; n < bent->nodes.size(); ++n) {
    const double plain = std::acos(double{scene.tree.nodes[n].cos_angle});
    // cos() of floats near 0 and pi tells angles to about 0.0005.
    if (plain + 0.5 > 3.1) continue;
    EXPECT_NEAR(std::acos(double{bent->nodes[n].cos_angle}), plain + 0.5, 1e-3);
  }
}

TEST(SphereTree, MeansOfAttributes) {
  const SurfelScene scene = torus_scene(1000);
  std::vector<glm::vec4> colours;
  for (std::size_t k = 0; k < 1000; ++k)
    colours.emplace_back(static_cast<float>(k), 1.0F, 0.0F, 1.0F);
  const auto means = mean_by_node(scene.tree, std::span<const glm::vec4>(colours));
  ASSERT_EQ(means.size(), scene.tree.nodes.size());
  // Floats of some hundreds, summed over six levels.
  EXPECT_NEAR(means[0].x, 499.5F, 0.01F);
  EXPECT_NEAR(means[0].y, 1.0F, 1e-5F);
}

TEST(SphereTree, IsBoundedForAnyInput) {
  const SurfelScene none{test::SampledSurface{}};
  EXPECT_TRUE(none.tree.nodes.empty());
  EXPECT_TRUE(cut_sphere_tree(none.tree, make_view(Camera{}, 10, 10, 0.1), {}).surfels.empty());
  test::SampledSurface same;
  same.positions.assign(10000, glm::dvec3(1, 2, 3));
  same.normals.assign(10000, glm::vec3(0, 0, 1));
  const SurfelScene coincident{same};
  EXPECT_EQ(coincident.tree.nodes.size(), 1U) << "a leaf that cannot be divided";
  test::SampledSurface nearer;  // each half would hold all but one
  for (int k = 0; k < 20000; ++k) nearer.positions.emplace_back(std::exp2(-0.05 * k), 0.0, 0.0);
  nearer.normals.assign(nearer.positions.size(),
                        glm::vec3(std::numeric_limits<float>::quiet_NaN()));
  const SurfelScene deep{nearer};
  EXPECT_LT(deep.tree.nodes.size(), 20000U);
  for (const SphereNode& node : deep.tree.nodes) {
    ASSERT_EQ(node.cos_angle, -1.0F) << "without normals, seen from all sides";
    ASSERT_TRUE(std::isfinite(node.radius) && std::isfinite(node.mean_radius));
  }
}

TEST(SphereTree, DoesNotDependOnThreads) {
  const SurfelScene many = torus_scene(20000);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const SurfelScene one = torus_scene(20000);
  EXPECT_EQ(many.tree.order, one.tree.order);
  ASSERT_EQ(many.tree.nodes.size(), one.tree.nodes.size());
  for (std::size_t n = 0; n < one.tree.nodes.size(); ++n) {
    EXPECT_EQ(many.tree.nodes[n].radius, one.tree.nodes[n].radius);
    EXPECT_EQ(many.tree.nodes[n].axis, one.tree.nodes[n].axis);
  }
}

}  // namespace
}  // namespace relief
