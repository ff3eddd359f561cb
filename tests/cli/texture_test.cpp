// relief render --texture: a textured mesh through the engine `ewa`.
#include <cmath>

#include "common/image/image_io.h"
#include "tests/cli/run_relief.h"

namespace relief::test {
namespace {

const std::string kSquare =
    "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "f 1/1 2/2 3/3 4/4\n";

class TextureCli : public CliTest {
 protected:
  /// 32 x 32 texels, the left half red and the right half blue.
  [[nodiscard]] std::string write_texture() const {
    Image image{32, 32, {}};
    for (const char* name : {"R", "G", "B"}) {
      Channel channel{name, ChannelType::Float, {}};
      for (int i = 0; i < 32 * 32; ++i) {
        const bool left = i % 32 < 16;
        channel.values.push_back(name[0] == (left ? 'R' : 'B') ? 1.0F : 0.0F);
      }
      image.channels.push_back(channel);
    }
    std::string file = path("texture.png");
    EXPECT_TRUE(write_png(file, image));
    return file;
  }
};

TEST_F(TextureCli, SplatsShowTheTextureWhereItIs) {
  const std::string mesh = write("square.obj", kSquare);
  const std::string texture = write_texture();
  for (const char* method : {"given", "ewa", "optimised"}) {
    const Outcome run = run_relief({"render", mesh, "-o", path("out.exr"), "--engine", "ewa",
                                    "--texture", texture, "--acquisition", method, "--points",
                                    "2000", "--material", "unlit", "--size", "64x64", "--json"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.err.find("2000 splats"), std::string::npos) << run.err;
    EXPECT_EQ(run.err.find("condition") != std::string::npos, std::string(method) == "optimised");
    const auto image = read_image(path("out.exr"));
    ASSERT_TRUE(image);
    // A pixel left of the middle and one right of it, far from the edge between the colours, where
    // all coefficients are the texture's: what the fit's decaying overshoot leaves there is small.
    for (const std::size_t x : {24U, 40U}) {
      const std::size_t pixel = std::size_t{32} * 64 + x;
      EXPECT_NEAR(image->find("R")->values[pixel], x < 32 ? 1.0F : 0.0F, 0.02F) << method;
      EXPECT_NEAR(image->find("G")->values[pixel], 0.0F, 0.02F) << method;
      EXPECT_NEAR(image->find("B")->values[pixel], x < 32 ? 0.0F : 1.0F, 0.02F) << method;
    }
    for (const Channel& channel : image->channels) {
      for (const float value : channel.values) EXPECT_FALSE(std::isnan(value)) << channel.name;
    }
  }
}

TEST_F(TextureCli, SaysWhatIsMissing) {
  const std::string texture = write_texture();
  const auto render = [&](const std::string& mesh, const std::string& file) {
    return std::vector<std::string>{"render",   mesh,  "-o",        path("out.png"),
                                    "--engine", "ewa", "--texture", file};
  };
  expect_refused(render(write("bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), texture),
                 "texture coordinates");
  expect_refused(render(write("points.xyz", "0 0 0\n1 0 0\n0 1 0\n"), texture), "triangles");
  const std::string square = write("square.obj", kSquare);
  expect_refused(render(square, path("none.png")), "none.png");
  expect_refused(render(square, write("noise.png", "no picture")), "noise.png");
  auto many = render(square, texture);
  many.insert(many.end(), {"--points", "99999999"});
  expect_refused(many, "99999999 points");
}

TEST_F(TextureCli, PatchesAndRaysShowTheTexture) {
  const std::string texture = write_texture();
  const std::string mesh = write("square.obj", "mtllib square.mtl\nusemtl m\n" + kSquare);
  (void)write("square.mtl", "newmtl m\nmap_Kd texture.png\n");
  ASSERT_EQ(
      run_relief({"convert", mesh, "-o", path("square.relief"), "--spacing", "0.05"}).exit_code, 0);
  const std::vector<std::vector<std::string>> methods{
      {path("square.relief")},
      {path("square.relief"), "--engine", "multipass"},
      {path("square.relief"), "--engine", "raytrace"},
      {mesh, "--engine", "raytrace"},
      {write("bare.obj", kSquare), "--engine", "raytrace", "--texture", texture}};
  for (const std::vector<std::string>& method : methods) {
    std::vector<std::string> arguments{"render", "-o",     path("out.exr"), "--material",
                                       "unlit",  "--size", "64x64"};
    arguments.insert(arguments.end(), method.begin(), method.end());
    const Outcome run = run_relief(arguments);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    // Where neither llvmpipe nor Embree draws, a GPU does, which may round to half floats toward 0.
    const bool is_exact = run.out.find("llvmpipe") != std::string::npos ||
                          run.out.find("Embree") != std::string::npos;
    const float rounding = is_exact ? 0.0F : 0x1p-11F;
    const auto image = read_image(path("out.exr"));
    ASSERT_TRUE(image);
    for (const std::size_t x : {24U, 40U}) {
      const std::size_t pixel = std::size_t{32} * 64 + x;
      // Black and white have exact codes, whatever filters constant colours.
      EXPECT_NEAR(image->find("R")->values[pixel], x < 32 ? 1.0F : 0.0F, rounding)
          << method.front();
      EXPECT_NEAR(image->find("B")->values[pixel], x < 32 ? 0.0F : 1.0F, rounding)
          << method.front();
    }
  }
}

TEST_F(TextureCli, ConversionsSayWhatIsMissing) {
  const std::string mesh = write("square.obj", "mtllib square.mtl\nusemtl m\n" + kSquare);
  (void)write("square.mtl", "newmtl m\nmap_Kd gone.png\n");
  const std::vector<std::string> convert{"convert", mesh, "-o", path("square.relief")};
  expect_refused(convert, "gone.png");
  expect_refused({"render", mesh, "-o", path("o.png")}, "gone.png");
  auto fine = convert;
  fine.insert(fine.end(),
              {"--texture", write_texture(), "--texels-per-cell", "64", "--spacing", "0.005"});
  expect_refused(fine, "64 texels a cell");
}

TEST_F(TextureCli, NeedsTheEngineThatSplats) {
  const std::string square = write("square.obj", kSquare);
  EXPECT_EQ(run_relief({"render", square, "-o", path("o.png"), "--engine", "ewa", "--points", "5"})
                .exit_code,
            2);
}

}  // namespace
}  // namespace relief::test
