// relief convert --noise: what is measured, removed and reported.
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "tests/cli/json_test.h"

namespace relief::test {
namespace {

using nlohmann::json;

class Noise : public JsonTest {
 protected:
  /// A plane of 60 x 60 points a unit apart, with noise of half a unit and a point far above it.
  std::string write_noisy_plane() {
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0.0, 0.5);
    std::ofstream file(path("noisy.xyz"));
    for (int y = 0; y < 60; ++y) {
      for (int x = 0; x < 60; ++x) file << x << ' ' << y << ' ' << noise(random) << '\n';
    }
    file << "30.5 30.5 20\n";
    return path("noisy.xyz");
  }
};

TEST_F(Noise, IsMeasuredRemovedAndReported) {
  const std::string scan = write_noisy_plane();
  const json result = run_json({"convert", scan, "-o", path("plane.relief")});
  EXPECT_NEAR(result["noise"].get<double>(), 0.5, 0.06);
  EXPECT_EQ(result["points_moved"], 3600);
  EXPECT_EQ(result["stray_points_removed"], 1);
  EXPECT_EQ(result["patches"], 1);
  EXPECT_NEAR(result["error_rms"].get<double>(), 0.5, 0.06);
  const Outcome text = run_relief({"convert", scan, "-o", path("plane.relief")});
  EXPECT_NE(text.out.find("(standard deviation), removed from 3600 points"), std::string::npos)
      << text.out;
  EXPECT_NE(text.out.find("1 stray points left out"), std::string::npos) << text.out;
}

TEST_F(Noise, IsKeptOrRemovedAsGiven) {
  const std::string scan = write_noisy_plane();
  const json kept = run_json({"convert", scan, "-o", path("plane.relief"), "--noise", "0"});
  EXPECT_EQ(kept["points_moved"], 0);
  EXPECT_LT(kept["error_rms"].get<double>(), 0.4) << "the surface follows the noise";
  const json given = run_json({"convert", scan, "-o", path("plane.relief"), "--noise", "0.4"});
  EXPECT_NEAR(given["noise"].get<double>(), 0.4, 1e-6);
  EXPECT_EQ(given["points_moved"], 3600);
}

TEST_F(Noise, WrongValuesAreWrongUsage) {
  const std::string scan = write_noisy_plane();
  for (const char* value : {"-1", "nan", "inf", "1e300", "much"}) {
    const Outcome run =
        run_relief({"convert", scan, "-o", path("plane.relief"), std::string("--noise=") + value});
    EXPECT_EQ(run.exit_code, 2) << value;
    EXPECT_NE(run.err.find("expected auto or a number from 0 to 1e100"), std::string::npos)
        << run.err;
    EXPECT_FALSE(std::filesystem::exists(path("plane.relief")));
  }
}

}  // namespace
}  // namespace relief::test
