// The bumpy sphere that rivals are measured on: writes scans of it and what a camera should see.
// scripts/measure_rivals.sh runs it.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "common/image/image_io.h"
#include "tests/experiments/rival_scene.h"

namespace relief::experiment {
namespace {

constexpr std::size_t kPoints = 400000;
constexpr int kRays = 32;

struct Look {
  const char* name;
  double distance;
};

bool write_file(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return file.good();
}

int run(const std::filesystem::path& folder, double cube) {
  RivalScene scene;
  scene.cube = cube;
  const bool even = write_file(folder / "even.ply", scan_ply(scene, kPoints, PointPattern::Even));
  const bool other =
      write_file(folder / "random.ply", scan_ply(scene, kPoints, PointPattern::Random));
  if (!even || !other) {
    fmt::print(stderr, "{}: can't be written\n", folder.string());
    return 1;
  }
  // The same as --eye 0,0,D --target 0,0,0.
  for (const Look& look : {Look{"full", 3.0}, Look{"close", 1.6}}) {
    const Camera camera{{0.0, 0.0, look.distance}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 45.0};
    const Image truth = draw_truth(scene, camera, 1280, 1024, kRays);
    for (const Status& written :
         {write_exr(folder / fmt::format("truth_{}.exr", look.name), truth),
          write_png(folder / fmt::format("truth_{}.png", look.name), truth)}) {
      if (written) continue;
      fmt::print(stderr, "{}\n", written.error().message);
      return 1;
    }
  }
  return 0;
}

}  // namespace
}  // namespace relief::experiment

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: rival_experiment FOLDER CUBE\n", stderr);
    return 2;
  }
  return relief::experiment::run(argv[1], std::stod(argv[2]));
}
