// The same scene in all formats: Gaussians and their colours stay where they are in the world.
#include "preprocess/gaussians/read_gaussians.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "common/volume/spherical_harmonics.h"
#include "tests/common/patch_file/sample_models.h"
#include "tests/preprocess/gaussians/gaussian_files.h"

namespace relief::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// What a format's steps allow.
struct Tolerances {
  float centre = 1e-6F;
  float log_scale = 1e-5F;  ///< a float's logarithm of e^-6 to 1
  float angle = 1e-3F;      ///< radians: acos near 1 makes 4e-4 of a float's steps
  float opacity = 1e-6F;
  float degree0 = 1e-6F;
  float harmonic = 1e-6F;
};

/// Half a step of each number. A range of 9 has 10 or 11 bits; three components of a quaternion
/// have steps of sqrt(2) / 1023, and an angle is at most twice the length of their errors, times
/// 1.6 for the fourth; a colour's range is 2 (or 1) of 8 bits.
constexpr Tolerances kCompressed{.centre = 0.0045F,
                                 .log_scale = 0.0045F,
                                 .angle = 0.004F,
                                 .opacity = 0.002F,
                                 .degree0 = 0.0143F,
                                 .harmonic = 0.0161F};
/// Half a step each: 2^-13; 1/32; 1/510; 1/255/0.15/2; 1/256. Quaternions: as above, with steps of
/// sqrt(1/2) / 511.
constexpr Tolerances kSpz{.centre = 0.000125F,
                          .log_scale = 0.0313F,
                          .angle = 0.004F,
                          .opacity = 0.002F,
                          .degree0 = 0.0132F,
                          .harmonic = 0.004F};
/// Quaternions of 8 bits: steps of 1/127.5. Halfs of 2 to 4 have steps of 1/512.
constexpr Tolerances spz_tolerances(std::uint32_t version) {
  Tolerances tolerances = kSpz;
  if (version < 3) tolerances.angle = 0.022F;
  if (version == 1) tolerances.centre = 0.001F;
  return tolerances;
}

glm::dvec3 colour_along(glm::dvec3 direction, int degree, std::span<const glm::vec3> harmonics) {
  std::vector<double> basis(harmonics_of(degree));
  harmonics_basis(direction, degree, basis);
  glm::dvec3 colour(0.5);
  for (std::size_t c = 0; c < basis.size(); ++c) colour += basis[c] * glm::dvec3(harmonics[c]);
  return colour;
}

/// Checks that a cloud is the scene, whose axes point as `axes` in the cloud's frame.
void expect_scene(const GaussianCloud& cloud, const SampleScene& scene, glm::vec3 axes,
                  const Tolerances& tolerances, const std::string& name) {
  ASSERT_EQ(cloud.size(), scene.gaussians.size()) << name;
  ASSERT_EQ(cloud.degree, scene.degree) << name;
  const std::size_t stride = harmonics_of(scene.degree);
  ASSERT_EQ(cloud.harmonics.size(), stride * cloud.size()) << name;
  EXPECT_EQ(cloud.stance, Stance{}) << name;
  for (std::size_t k = 0; k < cloud.size(); ++k) {
    const SampleGaussian& wanted = scene.gaussians[k];
    const glm::vec3 centre = axes * wanted.centre;
    for (glm::length_t a = 0; a < 3; ++a) {
      EXPECT_NEAR(cloud.centres[k][a], centre[a], tolerances.centre) << name;
      EXPECT_NEAR(std::log(cloud.scales[k][a]), wanted.log_scales[a], tolerances.log_scale) << name;
    }
    // The own axes in the world, each up to its sign, which a Gaussian does not have.
    const glm::mat3 got = glm::mat3_cast(cloud.rotations[k]);
    const glm::mat3 own = glm::mat3_cast(wanted.rotation);
    for (glm::length_t a = 0; a < 3; ++a) {
      const float cosine = std::abs(glm::dot(got[a], axes * own[a]));
      EXPECT_LT(std::acos(std::min(1.0F, cosine)), tolerances.angle) << name;
    }
    EXPECT_NEAR(glm::length(cloud.rotations[k]), 1.0F, 1e-6F) << name;  // of a float's steps
    EXPECT_NEAR(cloud.opacities[k], wanted.opacity, tolerances.opacity) << name;
    const auto harmonics = std::span(cloud.harmonics).subspan(k * stride, stride);
    for (std::size_t c = 0; c < stride; ++c) {
      for (glm::length_t a = 0; a < 3; ++a) {
        EXPECT_NEAR(std::abs(harmonics[c][a]), std::abs(wanted.harmonics[c][a]),
                    c == 0 ? tolerances.degree0 : tolerances.harmonic)
            << name << ", coefficient " << c;
      }
    }
    // Signs: a direction of the file has the same colour once it is turned into the world. A
    // coefficient of the other sign is off by 0.1 or more.
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (int i = 0; i < 20; ++i) {
      const glm::dvec3 along =
          glm::normalize(glm::dvec3(uniform(random), uniform(random), uniform(random)));
      const glm::dvec3 in_file = colour_along(along, scene.degree, wanted.harmonics);
      const glm::dvec3 in_world = colour_along(glm::dvec3(axes) * along, scene.degree, harmonics);
      // The sum of a basis' absolute values is at most 1 + 2 degree + 3.
      const double step = std::max(tolerances.harmonic, tolerances.degree0 * 0.3F);
      EXPECT_LT(glm::distance(in_file, in_world), step * (4.0 + 2.0 * scene.degree)) << name;
    }
  }
}

TEST(ReadGaussiansTest, PlainPly) {
  for (int degree = 0; degree <= kMaxHarmonicsDegree; ++degree) {
    const SampleScene scene = sample_scene(degree);
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
      const std::string name = fmt::format("{}{}.ply", format, degree);
      const GaussianCloud cloud = gaussians_of(name, plain_ply(scene, format));
      expect_scene(cloud, scene, {1.0F, -1.0F, -1.0F}, {}, name);
      EXPECT_FALSE(cloud.is_antialiased);
    }
  }
}

TEST(ReadGaussiansTest, ManyRowsKeepTheirOrder) {
  // More than two blocks of rows, and more than two chunks.
  const SampleScene scene = [] {
    SampleScene many{0, {}};
    const SampleScene three = sample_scene(0);
    for (std::size_t k = 0; k < 9000; ++k) {
      many.gaussians.push_back(three.gaussians[k % 3]);
      many.gaussians.back().centre.x = static_cast<float>(k) / 2048.0F;
    }
    return many;
  }();
  for (const char* format : {"ascii", "binary_little_endian"}) {
    expect_scene(gaussians_of("many.ply", plain_ply(scene, format)), scene, {1.0F, -1.0F, -1.0F},
                 {}, format);
  }
  expect_scene(gaussians_of("many.ply", compressed_ply(scene, true)), scene, {1.0F, -1.0F, -1.0F},
               kCompressed, "compressed");
  expect_scene(gaussians_of("many.spz", spz(scene, 4)), scene, glm::vec3(1.0F), kSpz, "spz");
}

TEST(ReadGaussiansTest, CompressedPly) {
  for (const int degree : {0, 1, 2, 3}) {
    const SampleScene scene = sample_scene(degree);
    for (const bool has_colours : {true, false}) {
      expect_scene(gaussians_of("a.ply", compressed_ply(scene, has_colours)), scene,
                   {1.0F, -1.0F, -1.0F}, kCompressed, fmt::format("degree {}", degree));
    }
  }
}

TEST(ReadGaussiansTest, SpzOfEachVersion) {
  for (const std::uint32_t version : {1U, 2U, 3U, 4U}) {
    for (int degree = 0; degree <= kMaxHarmonicsDegree; ++degree) {
      const SampleScene scene = sample_scene(degree);
      expect_scene(gaussians_of("a.spz", spz(scene, version)), scene, glm::vec3(1.0F),
                   spz_tolerances(version), fmt::format("version {} degree {}", version, degree));
    }
  }
  const SampleScene scene = sample_scene(3);
  expect_scene(gaussians_of("a.spz", plain_spz(scene, 3)), scene, glm::vec3(1.0F), kSpz,
               "unpacked");
  EXPECT_TRUE(
      gaussians_of("a.spz", packed_spz(scene, {.flags = 1, .extensions = {}})).is_antialiased);
  EXPECT_FALSE(gaussians_of("a.spz", packed_spz(scene)).is_antialiased);
}

TEST(ReadGaussiansTest, PlyThatIsAntialiasedSaysSo) {
  const SampleScene scene = sample_scene(0);
  const auto with = [](std::string file, std::string_view comment) {
    file.insert(file.find("element"), comment);
    return file;
  };
  for (const std::string& file :
       {plain_ply(scene, "ascii"), plain_ply(scene, "binary_little_endian"),
        compressed_ply(scene, true)}) {
    const auto is_antialiased = [&](std::string_view comment) {
      return gaussians_of("a.ply", with(file, comment)).is_antialiased;
    };
    EXPECT_TRUE(is_antialiased("comment SplatRenderMode: mip\n"));
    EXPECT_TRUE(is_antialiased("comment splatrendermode mip \r\n"));
    EXPECT_FALSE(is_antialiased("comment SplatRenderMode: default\n"));
    EXPECT_FALSE(is_antialiased("comment SplatRenderMode:\n"));
    EXPECT_FALSE(is_antialiased("comment mip\n"));
  }
}

/// A record of an extension that states a coordinate system.
std::string coordinate_system(std::uint32_t system) {
  return pack(std::uint32_t{0xADBE0003}, std::uint32_t{4}, system);
}

TEST(ReadGaussiansTest, SpzStatesItsAxes) {
  const SampleScene scene = sample_scene(4);
  const std::string unknown = pack(std::uint32_t{0x12340001}, std::uint32_t{3}) + "abc";
  const std::pair<std::uint32_t, glm::vec3> systems[] = {{0, {1, 1, 1}},   {4, {1, 1, 1}},
                                                         {6, {1, -1, -1}}, {1, {-1, -1, 1}},
                                                         {7, {-1, 1, -1}}, {8, {1, 1, -1}}};
  for (const auto& [system, axes] : systems) {
    const SpzExtras extras{2, unknown + coordinate_system(system)};
    const std::string name = fmt::format("system {}", system);
    expect_scene(gaussians_of("a.spz", packed_spz(scene, extras)), scene, axes, kSpz, name);
    expect_scene(gaussians_of("a.spz", gzip(plain_spz(scene, 3, extras))), scene, axes, kSpz, name);
  }
}

TEST(SphericalHarmonicsTest, TheBasisIsOrthonormal) {
  constexpr std::size_t count = harmonics_of(kMaxHarmonicsDegree);
  std::vector<double> products(count * count);
  // Rings of equal height and equal angles: for degrees up to 4 + 4 the angles are exact, the
  // heights to the square of the step.
  constexpr int rings = 1000;
  constexpr int angles = 12;
  for (int r = 0; r < rings; ++r) {
    const double z = -1.0 + 2.0 * (r + 0.5) / rings;
    for (int a = 0; a < angles; ++a) {
      const double angle = 2.0 * std::numbers::pi * a / angles;
      const double radius = std::sqrt(1.0 - z * z);
      std::vector<double> basis(count);
      harmonics_basis({radius * std::cos(angle), radius * std::sin(angle), z}, kMaxHarmonicsDegree,
                      basis);
      for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < count; ++k)
          products[i * count + k] += basis[i] * basis[k] * 4.0 * std::numbers::pi / rings / angles;
      }
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < count; ++k)
      EXPECT_NEAR(products[i * count + k], i == k ? 1.0 : 0.0, 1e-4) << i << ", " << k;
  }
}

TEST(ReadGaussiansTest, ScenesAreToldFromPoints) {
  const ScratchFolder scratch;
  const auto is_scene = [&](const char* name, const std::string& bytes) {
    spill(scratch / name, bytes);
    const auto found = is_gaussians(scratch / name);
    return found && *found;
  };
  const SampleScene scene = sample_scene(1);
  EXPECT_TRUE(is_scene("a.ply", plain_ply(scene, "ascii")));
  EXPECT_TRUE(is_scene("A.PLY", plain_ply(scene, "binary_big_endian")));
  EXPECT_TRUE(is_scene("a.compressed.ply", compressed_ply(scene, false)));
  EXPECT_TRUE(is_scene("a.ply.gz", gzip(plain_ply(scene, "ascii"))));
  EXPECT_TRUE(*is_gaussians("nowhere/a.spz"));
  EXPECT_FALSE(*is_gaussians("nowhere/a.obj"));
  const std::string points =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
      "property float z\nproperty float opacity\nproperty float scale_0\nend_header\n1 2 3 4 5\n";
  EXPECT_FALSE(is_scene("points.ply", points));
  EXPECT_FALSE(is_scene("points.ply.gz", gzip(points)));
  EXPECT_FALSE(is_scene("cut.ply", plain_ply(scene, "ascii").substr(0, 200)));
  EXPECT_FALSE(is_scene("noise.ply.gz", "\x1f\x8bnoise"));
  EXPECT_FALSE(is_gaussians(scratch / "missing.ply"));
}

TEST(ReadGaussiansTest, BadGaussiansAreDroppedWithOneNote) {
  const std::string header = plain_ply_header("binary_little_endian", 6, 1);
  const SampleScene scene = sample_scene(1, 6);
  // Columns: x; f_rest_4; opacity; scale_1; rot_0 to rot_3.
  const auto file = [&](bool all_bad) {
    std::string bytes = header;
    for (std::size_t k = 0; k < 6; ++k) {
      std::vector<float> row = plain_ply_row(scene.gaussians[k]);
      if (k == 1) row[0] = std::nanf("");
      if (k == 2) row[13] = kInfinity;
      if (k == 3) row[20] = -kInfinity;
      if (k == 5) std::fill(row.end() - 4, row.end(), 0.0F);
      if (all_bad) row[18] = std::nanf("");
      for (const float number : row) bytes += pack(number);
    }
    return bytes;
  };
  NotedProgress progress;
  const std::string bytes = file(false);
  const auto cloud = read_gaussian_bytes("a.ply", std::as_bytes(std::span(bytes)), progress);
  ASSERT_TRUE(cloud) << cloud.error().message;
  expect_scene(*cloud, {1, {scene.gaussians[0], scene.gaussians[4]}}, {1.0F, -1.0F, -1.0F}, {},
               "dropped");
  EXPECT_EQ(progress.notes,
            std::vector<std::string>{"a.ply: 4 of 6 Gaussians are dropped: they have a number that "
                                     "is not finite, a scale of 0 or a rotation of length 0"});
  EXPECT_EQ(
      gaussians_error("a.ply", file(true)),
      "none of its 6 Gaussians can be drawn: each has a number that is not finite, a scale of "
      "0 or a rotation of length 0");
  EXPECT_EQ(gaussians_error("a.ply", plain_ply({0, {}}, "ascii")), "holds no Gaussians");
  EXPECT_EQ(gaussians_error("a.spz", spz({0, {}}, 3)), "holds no Gaussians");
}

TEST(ReadGaussiansTest, InfiniteLogitsAreOpaqueOrClear) {
  SampleScene scene = sample_scene(0);
  scene.gaussians[0].opacity = 1.0F;
  scene.gaussians[1].opacity = 0.0F;
  const GaussianCloud cloud = gaussians_of("a.ply", plain_ply(scene, "binary_little_endian"));
  ASSERT_EQ(cloud.size(), 3U);
  EXPECT_EQ(cloud.opacities[0], 1.0F);
  EXPECT_EQ(cloud.opacities[1], 0.0F);
}

TEST(ReadGaussiansTest, CancelledReadsEnd) {
  for (const GaussianFile& file : gaussian_files()) {
    NotedProgress progress;
    progress.is_cancelled = true;
    const auto cloud =
        read_gaussian_bytes(file.name, std::as_bytes(std::span(file.bytes)), progress);
    ASSERT_FALSE(cloud) << file.name;
    EXPECT_EQ(cloud.error().message, "interrupted") << file.name;
  }
}

}  // namespace
}  // namespace relief::test
