// relief convert --spacing of a mesh: the finer the grids, the nearer the normals.
#include <cmath>
#include <glm/vec3.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>

#include "tests/cli/json_test.h"

namespace relief::test {
namespace {

using nlohmann::json;

constexpr int kAround = 100;
constexpr int kAcross = 50;

/// A ring with waves, and with edges where two of them meet. Its points lie up to three times as
/// far apart at one end as at the other, as those of decimated scans do.
glm::dvec3 on_ring(double u, double v) {
  const double waves = 0.04 * std::sin(7.0 * u) * std::sin(2.0 * v + 1.0);
  const double edges = 0.06 * std::abs(std::sin(3.0 * u + 2.0 * v));
  const double across = 0.5 + waves + edges;
  const double out = 1.0 + across * std::cos(v);
  return {out * std::cos(u) * std::exp(0.35 * out * std::cos(u)), out * std::sin(u),
          across * std::sin(v)};
}

class ConvergingNormals : public JsonTest {
 protected:
  std::string write_ring() {
    std::ostringstream file;
    const auto number = [](int i, int j) { return 1 + i % kAround * kAcross + j % kAcross; };
    for (int i = 0; i < kAround; ++i) {
      for (int j = 0; j < kAcross; ++j) {
        const glm::dvec3 p =
            on_ring(2.0 * std::numbers::pi * i / kAround, 2.0 * std::numbers::pi * j / kAcross);
        file << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
      }
    }
    for (int i = 0; i < kAround; ++i) {
      for (int j = 0; j < kAcross; ++j) {
        const int next = number(i + 1, j + 1);
        file << "f " << number(i, j) << ' ' << number(i + 1, j) << ' ' << next << '\n'
             << "f " << number(i, j) << ' ' << next << ' ' << number(i, j + 1) << '\n';
      }
    }
    return write("ring.obj", file.str());
  }

  /// How far the normals of an image of a model are off those of the mesh's.
  json compare(const std::string& model, const std::string& mesh, const std::string& engine) {
    if (truth_.empty()) truth_ = draw(mesh, "truth.exr", "raytrace");
    return run_json({"compare", draw(model, "image.exr", engine), truth_});
  }

 private:
  std::string draw(const std::string& model, const std::string& image, const std::string& engine) {
    const Outcome run = run_relief({"render", model, "-o", path(image), "--engine", engine,
                                    "--samples", "1", "--size", "640x640", "--orbit", "150,-20"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return path(image);
  }

  std::string truth_;
};

TEST_F(ConvergingNormals, NeverGetWorseAsTheSpacingShrinks) {
  const std::string mesh = write_ring();
  // The distance of its points, roughly. By default a mesh of so few has a third of it, two pixels
  // of these images. (In smaller ones a dozen pixels at contours decide.)
  const double usual = 0.06;
  std::map<std::string, json> before;
  for (const double share : {1.0, 0.7, 0.5, 0.35}) {
    run_json(
        {"convert", mesh, "-o", path("ring.relief"), "--spacing", std::to_string(share * usual)});
    for (const std::string engine : {"raytrace", "onepass"}) {
      const json now = compare(path("ring.relief"), mesh, engine);
      // From 1.5 and 6.1 degrees to 0.36 and 1.4 when written; to 8.0 and 58 while slits showed
      // between patches whose grids are finer than the points.
      if (before.contains(engine)) {
        EXPECT_LT(now["normal_rms_deg"], before[engine]["normal_rms_deg"]) << engine << share;
        EXPECT_LT(now["normal_p99_deg"], before[engine]["normal_p99_deg"]) << engine << share;
      }
      // Beside contours, which chords of the widest grids cut: 15, 8, 3 and 0 of 120,000 pixels.
      EXPECT_LT(now["holes"], 20) << engine << share;
      before[engine] = now;
    }
  }
}

}  // namespace
}  // namespace relief::test
