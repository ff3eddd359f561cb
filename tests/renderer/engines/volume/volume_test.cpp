// The engine `volume` against `volume-reference`, which draws the same in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "common/volume/gaussian_cloud.h"
#include "common/volume/scalar_volume.h"
#include "renderer/render.h"
#include "tests/renderer/images.h"

namespace relief {
namespace {

using test::psnr;

/// Two balls of different values, with a gap between them and a soft border.
float value_at(glm::dvec3 p) {
  const double a = 1.0 - glm::length(p - glm::dvec3(0.3, 0.1, -0.2)) / 0.7;
  const double b = 0.6 - glm::length(p - glm::dvec3(-0.5, -0.2, 0.4)) / 0.6;
  return static_cast<float>(std::max({a, b, 0.0}));
}

ScalarVolume make_volume(glm::uvec3 size, VolumePlacement placement,
                         const std::function<glm::dvec3(glm::uvec3)>& position) {
  ScalarVolume volume{size, std::move(placement), {}};
  for (std::uint32_t k = 0; k < size.z; ++k) {
    for (std::uint32_t j = 0; j < size.y; ++j) {
      for (std::uint32_t i = 0; i < size.x; ++i)
        volume.values.push_back(value_at(position({i, j, k})));
    }
  }
  return volume;
}

/// Over the box from -1 to 1.
ScalarVolume regular_volume(glm::uvec3 size) {
  const glm::dvec3 step = 2.0 / glm::dvec3(size - 1U);
  glm::dmat3 steps(0.0);
  for (glm::length_t a = 0; a < 3; ++a) steps[a][a] = step[a];
  return make_volume(size, RegularGrid{glm::dvec3(-1.0), steps}, [step](glm::uvec3 node) {
    return glm::dvec3(-1.0) + step * glm::dvec3(node);
  });
}

ScalarVolume rectilinear_volume() {
  RectilinearGrid grid;
  for (std::size_t a = 0; a < 3; ++a) {
    for (int n = 0; n < 24; ++n) {
      const double u = n / 23.0;
      grid.coordinates[a].push_back(-1.0 + 2.0 * (0.6 * u + 0.4 * u * u));
    }
  }
  const auto c = grid.coordinates;
  return make_volume({24, 24, 24}, grid,
                     [c](glm::uvec3 n) { return glm::dvec3(c[0][n.x], c[1][n.y], c[2][n.z]); });
}

GaussianCloud random_gaussians(std::size_t count, double scale) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  GaussianCloud cloud;
  for (std::size_t k = 0; k < count; ++k) {
    cloud.centres.emplace_back(unit(random), unit(random), unit(random));
    glm::vec3 scales(0.0F);
    for (glm::length_t a = 0; a < 3; ++a)
      scales[a] = static_cast<float>(scale) * std::exp(unit(random));
    cloud.scales.push_back(scales);
    cloud.rotations.push_back(
        glm::normalize(glm::quat(unit(random), unit(random), unit(random), 1.5F)));
    cloud.opacities.push_back(0.5F + 0.49F * unit(random));
    cloud.harmonics.emplace_back(unit(random), unit(random), unit(random));
  }
  return cloud;
}

RenderSettings settings_for(glm::dvec3 eye) {
  RenderSettings settings;
  settings.engine = "volume";
  settings.width = 120;
  settings.height = 96;
  settings.camera = {eye, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 40.0};
  settings.debug = true;
  return settings;
}

template <class Model>
RenderResult draw(const Model& model, RenderSettings settings, const char* engine) {
  settings.engine = engine;
  Progress silent;
  RenderModel form;
  form.add(model);
  auto result = render(form, settings, silent);
  if (result) return *std::move(result);
  ADD_FAILURE() << result.error().message;
  return {};
}

/// On the CPU the sums are the reference's, in single precision; weights are found from those
/// beside them, to 2e-5.
constexpr double kOnCpu = 85.0;

template <class Model>
void expect_alike(const Model& model, RenderSettings settings, double least) {
  const RenderResult truth = draw(model, settings, "volume-reference");
  EXPECT_GT(truth.covered_pixels, 500U) << "the test shows something";
  for (const VolumeDrawingBy by : {VolumeDrawingBy::Shaders, VolumeDrawingBy::Cpu}) {
    settings.volume.drawn_by = by;
    const RenderResult drawn = draw(model, settings, "volume");
    for (const Channel& channel : drawn.image.channels) {
      for (const float value : channel.values) ASSERT_FALSE(std::isnan(value)) << channel.name;
    }
    const bool is_on_cpu =
        by == VolumeDrawingBy::Cpu && settings.volume.visibility != VolumeVisibility::ImageSheet;
    EXPECT_GT(psnr(drawn.image, truth.image), is_on_cpu ? kOnCpu : least) << is_on_cpu;
  }
}

// The sheets' footprints have the Jacobian of the pixel instead of the kernel's centre, and colours
// 16 bits: the engine block has 83 dB, a grid this coarse less. Lists are the same sums in single
// precision: 113 dB there.
constexpr double kSheets = 50.0;
constexpr double kLists = 80.0;

const glm::dvec3 kEye(1.5, 1.1, 3.2);

TEST(VolumeEngine, RegularGrid) {
  expect_alike(regular_volume({40, 40, 40}), settings_for(kEye), kSheets);
}

TEST(VolumeEngine, EachAxisOfSheets) {
  const ScalarVolume volume = regular_volume({30, 34, 38});
  for (const glm::dvec3 eye : {glm::dvec3(3.5, 0.6, -0.9),
                               {-3.5, 0.4, 1.0},
                               {0.7, 3.5, 0.9},
                               {0.7, -3.5, 0.9},
                               {0.9, 0.6, -3.5}}) {
    expect_alike(volume, settings_for(eye), kSheets);
  }
}

TEST(VolumeEngine, AnisotropicGrid) {
  expect_alike(regular_volume({60, 40, 14}), settings_for(kEye), kSheets);
}

TEST(VolumeEngine, ExponentialAttenuation) {
  RenderSettings settings = settings_for(kEye);
  settings.volume.attenuation = Attenuation::Exponential;
  expect_alike(regular_volume({40, 40, 40}), settings, kSheets);
}

TEST(VolumeEngine, Orthographic) {
  RenderSettings settings = settings_for(kEye);
  settings.camera.orthographic_height = 2.6;
  expect_alike(regular_volume({40, 40, 40}), settings, kSheets);
}

TEST(VolumeEngine, EachFilter) {
  RenderSettings settings = settings_for(2.0 * kEye);
  for (const VolumeFilter filter : {VolumeFilter::Ewa, VolumeFilter::UniformScaling,
                                    VolumeFilter::Unfiltered, VolumeFilter::Dilated}) {
    settings.volume.filter = filter;
    SCOPED_TRACE(static_cast<int>(filter));
    expect_alike(regular_volume({40, 40, 40}), settings, kSheets);
  }
}

/// What OpenGL lights, what it leaves to the CPU, and what needs no light.
TEST(VolumeEngine, LightsAndMaterials) {
  const ScalarVolume volume = regular_volume({40, 33, 21});
  RenderSettings settings = settings_for(kEye);
  settings.lights.list = {{LightKind::Point, {1.0, 1.5, 2.0}, glm::vec3(4.0F)},
                          {LightKind::Directional, {0.0, 0.0, 1.0}, {0.2F, 0.5F, 0.3F}}};
  expect_alike(volume, settings, kSheets);
  settings.camera.orthographic_height = 2.6;
  expect_alike(volume, settings, kSheets);
  settings.material = Material::Mirror;
  expect_alike(volume, settings, kSheets);
  settings.material = Material::Unlit;
  expect_alike(volume, settings, kSheets);
}

/// Rays that pass the nodes, and kernels that reach beyond them: a full box has some at its border.
TEST(VolumeEngine, AFullBox) {
  ScalarVolume volume = regular_volume({12, 9, 15});
  for (float& value : volume.values) value += 0.5F;
  for (const glm::dvec3 eye : {glm::dvec3(4.0, 3.0, 6.0), {-6.0, 2.0, 1.0}, {0.5, -7.0, 0.3}}) {
    RenderSettings settings = settings_for(eye);
    // Footprints of the pixel's Jacobian: a spacing is 4 pixels here, and nodes are opaque.
    expect_alike(volume, settings, 45.0);
    settings.volume.filter = VolumeFilter::UniformScaling;
    expect_alike(volume, settings, 45.0);
  }
}

TEST(VolumeEngine, RectilinearGrid) {
  expect_alike(rectilinear_volume(), settings_for(kEye), kLists);
}

TEST(VolumeEngine, IsoSurface) {
  RenderSettings settings = settings_for(kEye);
  settings.volume.iso = 0.3;
  expect_alike(regular_volume({24, 24, 24}), settings, kLists);
}

TEST(VolumeEngine, ImageSheetsAndSorted) {
  RenderSettings settings = settings_for(kEye);
  settings.volume.visibility = VolumeVisibility::ImageSheet;
  // The normal distribution of the shader is right to 1e-7, and slabs have differences of it.
  expect_alike(regular_volume({20, 20, 20}), settings, kLists);
  settings.volume.visibility = VolumeVisibility::Sorted;
  expect_alike(regular_volume({20, 20, 20}), settings, kLists);
}

/// The mean difference of normals and depths that are finite in both images.
double surfaces_apart(const Image& a, const Image& b, const char* channel) {
  const std::vector<float>& drawn = a.find(channel)->values;
  const std::vector<float>& truth = b.find(channel)->values;
  double off = 0.0;
  for (std::size_t k = 0; k < drawn.size(); ++k) {
    if (std::isfinite(drawn[k]) && std::isfinite(truth[k]))
      off += static_cast<double>(std::abs(drawn[k] - truth[k]));
  }
  return off / static_cast<double>(drawn.size());
}

TEST(VolumeEngine, NormalAndDepth) {
  RenderSettings settings = settings_for(kEye);
  settings.outputs.normal = true;
  settings.outputs.depth = true;
  const ScalarVolume volume = regular_volume({32, 32, 32});
  for (const bool orthographic : {false, true}) {
    settings.camera.orthographic_height = orthographic ? 2.6 : 0.0;
    const RenderResult truth = draw(volume, settings, "volume-reference");
    for (const VolumeDrawingBy by : {VolumeDrawingBy::Shaders, VolumeDrawingBy::Cpu}) {
      settings.volume.drawn_by = by;
      const RenderResult drawn = draw(volume, settings, "volume");
      for (const char* const name : {"N.X", "N.Y", "N.Z", "Z"}) {
        // Shaders' normals have 8 bits: 0.004; depths are a few units. On the CPU a pixel is half
        // covered by the next sheet where sums differ by a rounding.
        EXPECT_LT(surfaces_apart(drawn.image, truth.image, name),
                  by == VolumeDrawingBy::Cpu ? 1e-4 : 0.004)
            << name;
      }
    }
  }
}

TEST(VolumeEngine, EyeInsideIsFinite) {
  RenderSettings settings = settings_for({0.3, 0.1, 0.3});
  settings.camera.target = {0.0, 0.0, -1.0};
  const ScalarVolume volume = regular_volume({40, 40, 40});
  const RenderResult drawn = draw(volume, settings, "volume");
  expect_alike(volume, settings, kLists);
  for (const Channel& channel : drawn.image.channels) {
    for (const float value : channel.values) ASSERT_TRUE(std::isfinite(value));
  }
}

TEST(VolumeEngine, Gaussians) {
  RenderSettings settings = settings_for(kEye);
  // Quads also blend the splat that ends a pixel: at most 0.01 of its colour.
  expect_alike(random_gaussians(2000, 0.03), settings, 50.0);
  settings.volume.gaussians.blend = GaussianBlend::Linear;
  expect_alike(random_gaussians(2000, 0.03), settings, 50.0);
  settings.camera.orthographic_height = 2.6;
  expect_alike(random_gaussians(2000, 0.03), settings, 50.0);
}

/// So long and thin that weights in a box differ by more than a float holds.
TEST(VolumeEngine, Needles) {
  GaussianCloud cloud = random_gaussians(300, 0.03);
  for (glm::vec3& scale : cloud.scales) scale = {0.4F, 1e-4F, 1e-4F};
  RenderSettings settings = settings_for(kEye);
  settings.width = 480;
  settings.height = 384;
  expect_alike(cloud, settings, 50.0);
}

TEST(VolumeEngine, GaussiansWithDepth) {
  RenderSettings settings = settings_for(kEye);
  settings.outputs.depth = true;
  expect_alike(random_gaussians(2000, 0.03), settings, kLists);
}

TEST(VolumeEngine, EyeAmongGaussians) {
  expect_alike(random_gaussians(2000, 0.05), settings_for({0.1, 0.05, 0.2}), 45.0);
}

TEST(VolumeEngine, TenThousandLayers) {
  GaussianCloud cloud = random_gaussians(10000, 0.05);
  for (glm::vec3& centre : cloud.centres) centre.x = centre.y = 0.0F;
  expect_alike(cloud, settings_for({0.0, 0.0, 3.0}), 50.0);
}

TEST(VolumeEngine, AnEmptyCloudShowsTheBackground) {
  const RenderResult drawn = draw(GaussianCloud{}, settings_for(kEye), "volume");
  EXPECT_EQ(drawn.covered_pixels, 0U);
}

TEST(VolumeEngine, AVolumeWithoutKernelsShowsTheBackground) {
  ScalarVolume volume = regular_volume({8, 8, 8});
  std::fill(volume.values.begin(), volume.values.end(), std::numeric_limits<float>::quiet_NaN());
  for (const char* const engine : {"volume", "volume-reference"})
    EXPECT_EQ(draw(volume, settings_for(kEye), engine).covered_pixels, 0U) << engine;
}

TEST(VolumeEngine, TheSameImageEachTime) {
  const auto check = [](const auto& model) {
    const RenderResult a = draw(model, settings_for(kEye), "volume");
    const RenderResult b = draw(model, settings_for(kEye), "volume");
    EXPECT_EQ(a.image.find("R")->values, b.image.find("R")->values);
  };
  check(regular_volume({24, 24, 24}));
  check(random_gaussians(2000, 0.03));
}

}  // namespace
}  // namespace relief
