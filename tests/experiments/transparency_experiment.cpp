// Measures [Zwicker 2001], Figure 7: crossing semi-transparent surfaces, by the engine `ewa` with 1
// to 8 layers a pixel, against transparency by ray tracing. usage: transparency_experiment OUT_DIR
// SCAN SCAN: a mesh for the second subject. Prints a Markdown table (PSNR in dB / FLIP) and writes
// OUT_DIR/transparency_SUBJECT_AZ_EL_WAY.png, WAY a number of layers or
// "truth".
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "common/bounds.h"
#include "common/image/image_io.h"
#include "preprocess/readers/read_points.h"
#include "renderer/render.h"
#include "tests/experiments/crossing_surfaces.h"
#include "tests/experiments/image_error.h"
#include "tests/experiments/ray_layers.h"

namespace relief::experiment {
namespace {

constexpr std::uint32_t kSide = 400;
constexpr int kSamples = 64;
constexpr float kOpacity = 0.5F;
constexpr std::array<int, 5> kLayers = {1, 2, 3, 4, 8};
/// Surfaces nearer to each other than this many h of the scene's median cross, or nearly so.
constexpr double kNear = 4.0;
constexpr std::uint32_t kCoarse = 257;  // points along a sheet's side
/// Pixels that a kernel reaches: sqrt(2 c (h^2 + 1)) with c = 1 and h up to 1.8 pixels.
constexpr std::uint32_t kReach = 3;

struct Subject {
  std::string name;
  Surfaces surfaces;
  Surfaces opaque;
  double near = 0.0;  ///< surfaces with less between them cross, world units
  std::vector<Orbit> orbits;
};

struct Region {
  std::string name;
  Mask mask;
};

/// What the pixels in a kernel's reach meet: as many surfaces each, or 0, and the least gap.
RayLayers layers_about(const std::vector<RayLayers>& layers, std::uint32_t x, std::uint32_t y) {
  RayLayers about = layers[std::size_t{y} * kSide + x];
  for (std::uint32_t j = y - kReach; j <= y + kReach; ++j) {
    for (std::uint32_t i = x - kReach; i <= x + kReach; ++i) {
      const RayLayers& pixel = layers[std::size_t{j} * kSide + i];
      if (pixel.surfaces != about.surfaces) return {};
      about.least_gap = std::min(about.least_gap, pixel.least_gap);
    }
  }
  return about;
}

/// Pixels by what lies behind each other in them; silhouettes are left out.
std::vector<Region> regions_of(const std::vector<RayLayers>& layers, double near) {
  std::vector<Region> regions(6);
  constexpr std::array<const char*, 6> kNames = {
      "whole image", "1 surface", "2, apart", "3, apart", "4 or more, apart", "at a crossing"};
  for (std::size_t r = 0; r < regions.size(); ++r)
    regions[r] = {kNames[r], Mask(layers.size(), r == 0 ? 1 : 0)};
  for (std::uint32_t y = kReach; y + kReach < kSide; ++y) {
    for (std::uint32_t x = kReach; x + kReach < kSide; ++x) {
      const RayLayers about = layers_about(layers, x, y);
      if (about.surfaces == 0) continue;
      const bool crossing = about.surfaces > 1 && about.least_gap < near;
      const auto region = static_cast<std::size_t>(crossing ? 5 : std::min(about.surfaces, 4));
      regions[region].mask[std::size_t{y} * kSide + x] = 1;
    }
  }
  return regions;
}

Result<Image> draw(const Surfaces& surfaces, const Camera& camera, std::string engine, int layers) {
  Progress progress;
  RenderSettings settings;
  settings.width = settings.height = kSide;
  settings.camera = camera;
  settings.material = Material::Lit;
  settings.background = glm::vec3(1.0F);
  settings.frames = 1;
  settings.raytrace.samples = kSamples;
  settings.ewa.layers = layers;
  auto result = engine == "ewa" ? render(surfaces.cloud, settings, progress)
                                : render(surfaces.mesh, settings, progress);
  if (!result) return result.error();
  return std::move(result->image);
}

/// An image and what it should be.
struct Pair {
  Image image;
  Image truth;
};

/// With each number of layers, and with opaque surfaces: what other errors are worth.
Result<std::vector<Pair>> draw_all(const Subject& subject, const Camera& camera,
                                   const std::string& prefix) {
  const auto truth = draw(subject.surfaces, camera, "raytrace", 1);
  const auto opaque_truth = draw(subject.opaque, camera, "raytrace", 1);
  const auto opaque = draw(subject.opaque, camera, "ewa", kLayers.back());
  if (!truth) return truth.error();
  if (!opaque_truth) return opaque_truth.error();
  if (!opaque) return opaque.error();
  const Status written = write_png(prefix + "_truth.png", *truth);
  if (!written) return written.error();
  std::vector<Pair> pairs;
  for (const int layers : kLayers) {
    const auto image = draw(subject.surfaces, camera, "ewa", layers);
    if (!image) return image.error();
    const Status done = write_png(fmt::format("{}_{}.png", prefix, layers), *image);
    if (!done) return done.error();
    pairs.push_back({*image, *truth});
  }
  pairs.push_back({*opaque, *opaque_truth});
  return pairs;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Status measure(const Subject& subject, const std::string& out) {
  const Bounds bounds = bounds_of(subject.surfaces.mesh.positions);
  const double radius = bounding_radius(subject.surfaces.mesh.positions, bounds);
  for (const Orbit& orbit : subject.orbits) {
    const Camera camera = orbit_camera(0.5 * (bounds.min + bounds.max), radius, orbit, 45.0, 1.0);
    const std::string prefix = fmt::format("{}/transparency_{}_{:g}_{:g}", out, subject.name,
                                           orbit.azimuth_degrees, orbit.elevation_degrees);
    const std::string view =
        fmt::format("{:g},{:g}", orbit.azimuth_degrees, orbit.elevation_degrees);
    const auto layers = find_layers(subject.surfaces.mesh, camera, kSide);
    if (!layers) return layers.error();
    const auto pairs = draw_all(subject, camera, prefix);
    if (!pairs) return pairs.error();
    for (const Region& region : regions_of(*layers, subject.near)) {
      const auto count = std::ranges::count(region.mask, 1);
      // Fewer pixels than FLIP's filters are wide say nothing.
      if (count < 200) continue;
      fmt::print("| {} | {} | {} | {} |", subject.name, view, region.name, count);
      for (const Pair& pair : *pairs)
        fmt::print(" {} |", as_cell(measure_error(pair.image, pair.truth, region.mask)));
      fmt::print("\n");
    }
  }
  return {};
}

void print_head() {
  fmt::print("| subject | azimuth, elevation | region | pixels |");
  for (const int layers : kLayers) fmt::print(" l = {} |", layers);
  fmt::print(" opaque, l = {} |\n| --- | --- | --- | ---: |", kLayers.back());
  for (std::size_t i = 0; i <= kLayers.size(); ++i) fmt::print(" ---: |");
  fmt::print("\n");
}

int run(int count, char** arguments) {
  if (count != 3) {
    fmt::print(stderr, "usage: transparency_experiment OUT_DIR SCAN\n");
    return 2;
  }
  Progress progress;
  const auto scan = read_points(arguments[2], progress);
  if (!scan) {
    fmt::print(stderr, "{}\n", scan.error().message);
    return 1;
  }
  const double near = kNear * median(crossing_sheets(kCoarse, kOpacity).cloud.radii);
  const Surfaces real = scan_through_sheet(scan->points, kOpacity);
  const auto sheets = [&](const char* name, std::uint32_t side, std::vector<Orbit> seen_from) {
    return Subject{name, crossing_sheets(side, kOpacity), crossing_sheets(side, 1.0F), near,
                   std::move(seen_from)};
  };
  const std::array<Subject, 4> subjects = {
      {sheets("sheets", kCoarse, {{20.0, 60.0, 0.0}, {60.0, 35.0, 0.0}, {90.0, 15.0, 0.0}}),
       sheets("sheets, 4 x points", 2 * kCoarse, {{20.0, 60.0, 0.0}}),
       sheets("sheets, 16 x points", 4 * kCoarse, {{20.0, 60.0, 0.0}}),
       {"scan",
        real,
        scan_through_sheet(scan->points, 1.0F),
        kNear * median(real.cloud.radii),
        {{20.0, 30.0, 0.0}, {140.0, 60.0, 0.0}}}}};
  print_head();
  for (const Subject& subject : subjects) {
    if (const Status done = measure(subject, arguments[1]); !done) {
      fmt::print(stderr, "{}\n", done.error().message);
      return 1;
    }
  }
  return 0;
}

}  // namespace
}  // namespace relief::experiment

int main(int count, char** arguments) {
  return relief::experiment::run(count, arguments);
}
