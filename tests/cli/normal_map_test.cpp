// Normal maps of meshes from the file to the image: relief convert, render and their messages.
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "common/image/image_io.h"
#include "common/image/srgb.h"
#include "tests/cli/run_relief.h"

namespace relief::test {
namespace {

constexpr std::uint32_t kSide = 256;

/// The square [-1, 1]^2 of z = 0; `texcoords`: its corners', counter-clockwise from the lower left.
std::string square(const std::string& texcoords = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n") {
  return "mtllib square.mtl\nusemtl m\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n" + texcoords +
         "f 1/1 2/2 3/3 4/4\n";
}

class NormalMapCli : public CliTest {
 protected:
  /// A map of the normals, any length, at (u, v), and a material file that names it.
  void write_map(const std::function<glm::dvec3(double, double)>& normal) const {
    Image image{kSide, kSide, {}};
    for (const char* name : {"R", "G", "B"})
      image.channels.push_back({name, ChannelType::Float, {}});
    for (std::uint32_t j = 0; j < kSide; ++j) {
      for (std::uint32_t i = 0; i < kSide; ++i) {
        const glm::dvec3 n = glm::normalize(normal((i + 0.5) / kSide, 1.0 - (j + 0.5) / kSide));
        for (std::size_t c = 0; c < 3; ++c) {
          // The light of the code that the pixel shall have.
          const long code = std::lround(127.5 + 127.5 * n[static_cast<glm::length_t>(c)]);
          image.channels[c].values.push_back(linear_from_srgb8(static_cast<std::uint8_t>(code)));
        }
      }
    }
    ASSERT_TRUE(write_png(path("normals.png"), image));
    (void)write("square.mtl", "newmtl m\nKd 0.7 0.7 0.7\nnorm normals.png\n");
  }

  /// Renders the square straight from above, 64 x 64 pixels of which the inner 46 or so show it.
  Image render(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"render", "-o", path("out.exr"), "--size", "64x64"});
    const Outcome run = run_relief(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    auto image = read_image(path("out.exr"));
    EXPECT_TRUE(image);
    return image ? *image : Image{};
  }
};

glm::dvec3 normal_at(const Image& image, std::size_t x, std::size_t y) {
  const std::size_t k = y * image.width + x;
  return {image.find("N.X")->values[k], image.find("N.Y")->values[k], image.find("N.Z")->values[k]};
}

double degrees_between(glm::dvec3 a, glm::dvec3 b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180.0 / std::acos(-1.0);
}

/// PSNR of the colours of the middle half each way, as a display shows them.
double inner_psnr(const Image& a, const Image& b) {
  double squares = 0.0;
  std::size_t count = 0;
  for (const char* name : {"R", "G", "B"}) {
    for (std::size_t y = a.height / 4; y < a.height - a.height / 4; ++y) {
      for (std::size_t x = a.width / 4; x < a.width - a.width / 4; ++x) {
        const std::size_t k = y * a.width + x;
        const double apart = srgb_from_linear(a.find(name)->values.at(k)) -
                             srgb_from_linear(b.find(name)->values.at(k));
        squares += apart * apart;
        ++count;
      }
    }
  }
  return -10.0 * std::log10(squares / static_cast<double>(count));
}

TEST_F(NormalMapCli, TiltsComeOutInImagesOfAllEngines) {
  // 8 bits make of this a normal that is up to 0.3 degrees off; what follows adds 0.1 degrees in
  // the patch file and less than that in half floats.
  const glm::dvec3 tilt = glm::normalize(glm::dvec3(0.3, -0.2, 0.8));
  write_map([&](double, double) { return tilt; });
  const struct {
    const char* texcoords;
    glm::dvec3 expected;
  } cases[] = {{"vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n", tilt},
               {"vt 1 0\nvt 0 0\nvt 0 1\nvt 1 1\n", {-tilt.x, tilt.y, tilt.z}},
               {"vt 0 1\nvt 1 1\nvt 1 0\nvt 0 0\n", {tilt.x, -tilt.y, tilt.z}},
               {"vt 0 1\nvt 0 0\nvt 1 0\nvt 1 1\n", {-tilt.y, tilt.x, tilt.z}}};
  for (const auto& [texcoords, expected] : cases) {
    const std::string mesh = write("square.obj", square(texcoords));
    const std::string patches = path("square.relief");
    ASSERT_EQ(run_relief({"convert", mesh, "-o", patches, "--spacing", "0.05"}).exit_code, 0);
    const std::vector<std::vector<std::string>> methods{{patches},
                                                        {patches, "--primitive", "quad"},
                                                        {patches, "--primitive", "sprite"},
                                                        {patches, "--engine", "multipass"},
                                                        {patches, "--engine", "ewa"},
                                                        {patches, "--engine", "raytrace"},
                                                        {mesh, "--engine", "raytrace"}};
    for (const std::vector<std::string>& method : methods) {
      const Image image = render(method);
      ASSERT_NE(image.find("N.X"), nullptr);
      for (const std::size_t x : {20U, 32U, 45U})
        EXPECT_LT(degrees_between(normal_at(image, x, 24), expected), 0.5) << method.back();
    }
  }
}

TEST_F(NormalMapCli, BumpsAreThoseOfTheMeshAndFinerThanTheGrid) {
  const double pi = std::acos(-1.0);
  write_map([pi](double u, double v) {
    return glm::dvec3(0.5 * std::cos(8.0 * pi * u), 0.5 * std::sin(8.0 * pi * v), 1.0);
  });
  const std::string mesh = write("square.obj", square());
  const std::string fine = path("fine.relief");
  const std::string coarse = path("coarse.relief");
  // A sample for a quarter of a wave.
  const std::vector<std::string> convert{"convert", mesh, "--spacing", "0.125", "-o"};
  const auto converted = [&](const std::string& file, const char* texels) {
    auto arguments = convert;
    arguments.push_back(file);
    if (texels != nullptr) arguments.insert(arguments.end(), {"--texels-per-cell", texels});
    return run_relief(arguments);
  };
  ASSERT_EQ(converted(fine, nullptr).exit_code, 0);
  ASSERT_EQ(converted(coarse, "1").exit_code, 0);
  for (const char* material : {"lit", "mirror"}) {
    const auto look = [&](const std::string& input, const char* engine) {
      return render({input, "--engine", engine, "--material", material, "--samples", "16"});
    };
    const Image truth = look(mesh, "raytrace");
    const double at_its_own = inner_psnr(look(fine, "onepass"), truth);
    const double at_the_grid = inner_psnr(look(coarse, "onepass"), truth);
    RecordProperty(material, std::to_string(at_its_own) + " " + std::to_string(at_the_grid));
    // The file rounds normals by 0.1 degrees at most, 0.0017 of the light and about twice that in
    // highlights: 50 dB. The mirror shows sharp lines, which move by a fifth of a degree: a
    // thirtieth of the light of the one pixel in 30 that has one, 30 dB and more.
    EXPECT_GT(at_its_own, std::string(material) == "lit" ? 50.0 : 30.0) << material;
    EXPECT_GT(at_its_own, at_the_grid + 9.0) << material;
  }
}

TEST_F(NormalMapCli, SaysWhatIsMissing) {
  const std::string mesh = write("square.obj", square());
  (void)write("square.mtl", "newmtl m\nnorm gone.png\n");
  const std::vector<std::string> convert{"convert", mesh, "-o", path("square.relief")};
  expect_refused(convert, "gone.png");
  expect_refused({"render", mesh, "-o", path("o.exr"), "--engine", "raytrace"}, "gone.png");
  (void)write("gone.png", "no picture");
  expect_refused(convert, "gone.png");
}

TEST_F(NormalMapCli, MeshesWithoutOneStayAsTheyAre) {
  const std::string mesh = write("square.obj", square());
  (void)write("square.mtl", "newmtl m\nKd 0.7 0.7 0.7\n");
  ASSERT_EQ(run_relief({"convert", mesh, "-o", path("plain.relief"), "--json"}).exit_code, 0);
  // Not a texel of normals more: one a node.
  const Outcome run = run_relief({"convert", mesh, "-o", path("fine.relief"), "--json",
                                  "--texels-per-cell", "4", "--spacing", "0.05"});
  EXPECT_NE(run.out.find("\"texels_per_cell\": 4"), std::string::npos);
  EXPECT_NE(run.out.find("\"normal_texels_per_cell\": 1"), std::string::npos) << run.out;
  // And images without a feature for them.
  const Outcome drawn =
      run_relief({"render", path("plain.relief"), "-o", path("o.exr"), "--explain", "--json"});
  EXPECT_EQ(drawn.out.find("fine_normals"), std::string::npos);
}

}  // namespace
}  // namespace relief::test
