// relief convert --normals: the side that normals of points face.
#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/cli/json_test.h"

namespace relief::test {
namespace {

class NormalsSide : public JsonTest {
 protected:
  /// A flat square of 40 x 40 points at z = 0.
  std::string write_square() {
    std::ofstream file(path("square.xyz"));
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 40; ++x) file << x + 0.1 * (y % 3) << ' ' << y << " 0\n";
    }
    return path("square.xyz");
  }

  /// The least and the largest z of the normals of a converted square's samples.
  std::pair<double, double> range_of_normals(const std::vector<std::string>& options) {
    std::vector<std::string> convert{"convert", write_square(), "-o", path("square.relief")};
    convert.insert(convert.end(), options.begin(), options.end());
    EXPECT_EQ(run_relief(convert).exit_code, 0);
    EXPECT_EQ(run_relief({"export", path("square.relief"), "-o", path("square.obj")}).exit_code, 0);
    std::ifstream file(path("square.obj"));
    std::pair<double, double> range{2.0, -2.0};
    for (std::string line; std::getline(file, line);) {
      std::istringstream words(line);
      std::string keyword;
      double n[3] = {};
      if (!(words >> keyword >> n[0] >> n[1] >> n[2]) || keyword != "vn") continue;
      range = {std::min(range.first, n[2]), std::max(range.second, n[2])};
    }
    return range;
  }
};

TEST_F(NormalsSide, IsAsAskedFor) {
  EXPECT_GT(range_of_normals({}).first, 0.9);
  EXPECT_GT(range_of_normals({"--normals", "up"}).first, 0.9);
  EXPECT_GT(range_of_normals({"--normals", "toward=10,10,5"}).first, 0.9);
  EXPECT_LT(range_of_normals({"--normals", "toward=10,10,-5"}).second, -0.9);
}

TEST_F(NormalsSide, IsRefusedIfNotKnown) {
  for (const char* const wrong : {"down", "toward", "toward=1,2", "toward=1,2,nan"}) {
    const Outcome outcome =
        run_relief({"convert", write_square(), "-o", path("square.relief"), "--normals", wrong});
    EXPECT_EQ(outcome.exit_code, 2) << wrong;
    EXPECT_NE(outcome.err.find(wrong == std::string("down") ? "found down" : "X,Y,Z"),
              std::string::npos)
        << outcome.err;
  }
}

}  // namespace
}  // namespace relief::test
