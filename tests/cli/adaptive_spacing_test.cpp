// relief convert --adaptive-spacing and --even-spacing: a scan whose density differs, its patches
// and its images.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tests/cli/run_relief.h"
#include "tests/common/patch_file/read_whole.h"

namespace relief::test {
namespace {

using nlohmann::json;

constexpr double kFinest = 0.01;
constexpr double kPi = std::numbers::pi;

/// Points of the unit sphere on rings, 0.01 apart at the bottom to 0.08 at the top, with normals.
std::string sphere_of_uneven_density() {
  std::string points;
  double turn = 0.0;
  for (double polar = 0.0; polar < kPi;) {
    const double spacing = kFinest * std::pow(8.0, (std::cos(polar) + 1.0) / 2.0);
    const int count =
        std::max(1, static_cast<int>(std::lround(2.0 * kPi * std::sin(polar) / spacing)));
    turn += 2.4;  // rings do not line up
    for (int k = 0; k < count; ++k) {
      const double angle = turn + 2.0 * kPi * k / count;
      const double r = std::sin(polar);
      points += fmt::format("{0} {1} {2} {0} {1} {2}\n", r * std::cos(angle), r * std::sin(angle),
                            std::cos(polar));
    }
    polar += spacing;
  }
  return points;
}

/// The unit sphere as a mesh of 20,000 triangles, within 0.0003 of it.
std::string sphere_mesh() {
  constexpr int rings = 100;
  constexpr int sectors = 200;
  std::string vertices;
  std::string faces;
  for (int j = 0; j <= rings; ++j) {
    const double polar = kPi * j / rings;
    for (int i = 0; i < sectors; ++i) {
      const double angle = 2.0 * kPi * i / sectors;
      vertices += fmt::format("v {} {} {}\n", std::sin(polar) * std::cos(angle),
                              std::sin(polar) * std::sin(angle), std::cos(polar));
    }
  }
  for (int j = 0; j < rings; ++j) {
    for (int i = 0; i < sectors; ++i) {
      const int a = j * sectors + i + 1;
      const int b = j * sectors + (i + 1) % sectors + 1;
      faces +=
          fmt::format("f {} {} {}\nf {} {} {}\n", a, a + sectors, b + sectors, a, b + sectors, b);
    }
  }
  return vertices + faces;
}

class AdaptiveSpacing : public CliTest {
 protected:
  json run(std::vector<std::string> arguments) {
    arguments.emplace_back("--json");
    const Outcome outcome = run_relief(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return json::parse(outcome.out, nullptr, false);
  }

  /// The coarsest patch's spacing over the finest one's.
  [[nodiscard]] double spacing_ratio(const std::string& file) const {
    const PatchModel model = read_whole(path(file));
    const auto [finest, coarsest] =
        std::ranges::minmax(model.patches, {}, [](const Patch& patch) { return patch.spacing; });
    return coarsest.spacing / finest.spacing;
  }
};

TEST_F(AdaptiveSpacing, FollowsTheDensityAndClosesWithoutHoles) {
  const std::string scan = write("scan.xyz", sphere_of_uneven_density());
  const std::string mesh = write("sphere.obj", sphere_mesh());
  const json even = run({"convert", scan, "-o", path("even.relief"), "--even-spacing"});
  const json adaptive = run({"convert", scan, "-o", path("adaptive.relief")});
  run({"convert", scan, "-o", path("asked.relief"), "--adaptive-spacing"});
  EXPECT_EQ(file_bytes(path("asked.relief")), file_bytes(path("adaptive.relief"))) << "the default";
  EXPECT_EQ(spacing_ratio("even.relief"), 1.0);
  EXPECT_GT(spacing_ratio("adaptive.relief"), 3.0);
  EXPECT_LE(spacing_ratio("adaptive.relief"), 8.0);
  EXPECT_EQ(adaptive["uncovered_points"], 0);
  // As many samples of their own, more in margins: coarse patches have wide ones.
  EXPECT_LT(adaptive["samples"].get<double>(), 1.15 * even["samples"].get<double>());

  // Around, and from the dense and the sparse pole (the z axis), where spacings meet.
  for (const std::string orbit : {"0,0", "40,10", "90,50", "180,-40", "270,80", "0,-85"}) {
    const std::vector<std::string> view{"--orbit", orbit, "--size", "320x256"};
    const auto draw = [&](const std::string& model, const std::string& image,
                          std::vector<std::string> options) {
      std::vector<std::string> arguments{"render", model, "-o", path(image)};
      arguments.insert(arguments.end(), view.begin(), view.end());
      arguments.insert(arguments.end(), options.begin(), options.end());
      run(arguments);
    };
    draw(mesh, "truth.exr", {"--engine", "raytrace"});
    for (const std::string primitive : {"cell", "quad"}) {
      draw(path("adaptive.relief"), "patches.exr",
           {"--primitive", primitive, "--pixels-per-sample", "0"});
      const json errors = run({"compare", path("patches.exr"), path("truth.exr")});
      EXPECT_EQ(errors["holes"], 0) << primitive << " at " << orbit;
    }
  }
}

}  // namespace
}  // namespace relief::test
