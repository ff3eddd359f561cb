// Measures [Zwicker 2001], section 5: optimised against view-independent texture acquisition and
// the texture's values as given, at three magnifications (Figure 6), through the engine `ewa`.
// usage: texture_experiment OUT_DIR NAME MESH|- TEXTURE|- POINTS AZ,EL CUTOFF
// -: checkerboard plane. Prints rows of a Markdown table (for each view PSNR in dB against the
// Gaussian truth / PSNR against the box truth / FLIP against it; then the minified view's PSNR by
// measure_function) and writes OUT_DIR/NAME_CUTOFF_VIEW_WAY.png.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <string>
#include <utility>
#include <vector>

#include "common/image/image_io.h"
#include "preprocess/readers/read_points.h"
#include "preprocess/texture/acquisition/acquire_texture.h"
#include "preprocess/texture/acquisition/surface_points.h"
#include "tests/experiments/draw_unlit.h"
#include "tests/experiments/textured_truth.h"

namespace relief::experiment {
namespace {

constexpr std::uint32_t kSide = 256;

struct Subject {
  std::string name;
  Points mesh;
  Image texture;
  std::size_t points = 0;
  double azimuth = 0.0;
  double elevation = 0.0;
  double cutoff = 1.0;  ///< of the fit and of the engine
};

/// Figure 6's plane: 16 x 16 squares of 16 x 16 texels.
void make_checkerboard(Subject& subject) {
  subject.mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  subject.mesh.texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  subject.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  subject.texture = {256, 256, {}};
  for (const char* name : {"R", "G", "B"}) {
    Channel channel{name, ChannelType::Float, {}};
    for (std::uint32_t i = 0; i < 256 * 256; ++i) {
      const bool white = ((i % 256 / 16) + (i / 256 / 16)) % 2 == 1;
      channel.values.push_back(white ? 1.0F : 0.0F);
    }
    subject.texture.channels.push_back(channel);
  }
}

/// A camera that shows `h` (world) as `pixels`, at the mesh's place nearest to the viewer.
Camera close_camera(const Subject& subject, double h, double pixels) {
  const double azimuth = glm::radians(subject.azimuth);
  const double elevation = glm::radians(subject.elevation);
  const glm::dvec3 towards(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                           std::cos(azimuth) * std::cos(elevation));
  Camera camera;
  camera.vertical_fov_degrees = 30.0;
  camera.target = glm::dvec3(0.0);
  if (subject.mesh.size() > 4) {
    camera.target = *std::ranges::max_element(subject.mesh.positions, {},
                                              [&](glm::dvec3 p) { return glm::dot(p, towards); });
  }
  const double focal = 0.5 * kSide / std::tan(glm::radians(camera.vertical_fov_degrees) / 2.0);
  camera.eye = camera.target + towards * (h * focal / pixels);
  return camera;
}

SplatCloud as_cloud(const TexturedSplats& splats) {
  SplatCloud cloud;
  cloud.positions = splats.positions;
  cloud.normals = splats.normals;
  cloud.radii.assign(splats.positions.size(), splats.deviation);
  for (const glm::vec3 colour : splats.colours) cloud.colours.emplace_back(colour, 1.0F);
  return cloud;
}

struct Method {
  const char* name;
  Acquisition acquisition;
};
constexpr Method kMethods[] = {{"given", Acquisition::Given},
                               {"ewa", Acquisition::ViewIndependent},
                               {"optimised", Acquisition::Optimised}};
struct Zoom {
  const char* name;
  double pixels;  ///< between two splats
};
constexpr Zoom kZooms[] = {{"minification", 0.5}, {"magnification", 4.0}, {"extreme", 16.0}};

/// A view of the subject, and what it should show.
struct ShownView {
  std::string name;
  Camera camera;
  Truths truths;
};

std::vector<ShownView> make_views(const Subject& subject, const ContinuousTexture& texture) {
  const double spacing =
      std::sqrt(area_of(subject.mesh).world / static_cast<double>(subject.points));
  std::vector<ShownView> views;
  for (const Zoom& zoom : kZooms) {
    const Camera camera = close_camera(subject, spacing, zoom.pixels);
    views.push_back({zoom.name, camera, render_truth(subject.mesh, texture, camera, kSide)});
  }
  return views;
}

Result<Image> draw(const SplatCloud& cloud, const Camera& camera, double cutoff,
                   std::uint32_t side = kSide) {
  EwaSettings ewa;
  ewa.cutoff = cutoff;
  return draw_unlit(cloud, camera, side, ewa);
}

/// PSNR and FLIP of a view as a cell of the table.
Result<std::string> as_cell(const Image& image, const Truths& truths) {
  const auto gaussian = measure_error(image, truths.gaussian.image, truths.gaussian.covered());
  if (!gaussian) return gaussian.error();
  const auto box = measure_error(image, truths.box.image, truths.box.covered());
  if (!box) return box.error();
  return fmt::format(" {:.1f} / {:.1f} / {:.3f} |", gaussian->psnr_db, box->psnr_db,
                     box->flip_mean);
}

/// PSNR of the function on the splats itself, against the Gaussian truth: drawn at eight times the
/// size, where the engine's own low-pass is nothing, and then filtered by a whole Gaussian.
Result<double> measure_function(const SplatCloud& cloud, const ShownView& view, double cutoff) {
  constexpr std::uint32_t kFiner = 8;
  const auto fine = draw(cloud, view.camera, cutoff, kSide * kFiner);
  if (!fine) return fine.error();
  const Channel* const channels[] = {fine->find("R"), fine->find("G"), fine->find("B")};
  const Truths filtered = filter_samples(kSide, kFiner, [&](glm::dvec2 place) {
    glm::dvec4 sample(0.0);
    const auto x = static_cast<std::int64_t>(std::floor(place.x * kFiner));
    const auto y = static_cast<std::int64_t>(std::floor(place.y * kFiner));
    if (x < 0 || y < 0 || x >= fine->width || y >= fine->height) return sample;
    const auto pixel = static_cast<std::size_t>(y * fine->width + x);
    for (glm::length_t c = 0; c < 3; ++c) sample[c] = double{channels[c]->values[pixel]};
    return sample;
  });
  const auto error = measure_error(filtered.gaussian.image, view.truths.gaussian.image,
                                   view.truths.gaussian.covered());
  if (!error) return error.error();
  return error->psnr_db;
}

Status measure(const Subject& subject, const std::string& out) {
  Progress progress;
  const auto texture = ContinuousTexture::from_image(subject.texture);
  if (!texture) return texture.error();
  const std::vector<ShownView> views = make_views(subject, *texture);
  const auto path = [&](const ShownView& view, const char* method) {
    return fmt::format("{}/{}_{:g}_{}_{}.png", out, subject.name, subject.cutoff, view.name,
                       method);
  };
  for (const ShownView& view : views) {
    Status written = write_png(path(view, "truth"), view.truths.gaussian.image);
    if (!written) return written;
  }
  for (const Method& method : kMethods) {
    AcquireOptions options;
    options.acquisition = method.acquisition;
    options.points = subject.points;
    options.cutoff = subject.cutoff;
    const auto acquired = acquire_texture(subject.mesh, subject.texture, options, progress);
    if (!acquired) return acquired.error();
    const SplatCloud cloud = as_cloud(acquired->splats);
    std::string row = fmt::format("| {} | {:g} | {} | {:.4f} |", subject.name, subject.cutoff,
                                  method.name, acquired->report.rms_error);
    for (const ShownView& view : views) {
      const auto image = draw(cloud, view.camera, subject.cutoff);
      if (!image) return image.error();
      const auto cell = as_cell(*image, view.truths);
      if (!cell) return cell.error();
      row += *cell;
      Status written = write_png(path(view, method.name), *image);
      if (!written) return written;
    }
    const auto function = measure_function(cloud, views.front(), subject.cutoff);
    if (!function) return function.error();
    row += fmt::format(" {:.1f} |", *function);
    if (const auto& fit = acquired->report.fit) {
      row += fmt::format(" {} | {:.1e} | {:.0f} |", fit->iterations, fit->residual,
                         fit->condition.value_or(std::nan("")));
    } else {
      row += " | | |";
    }
    fmt::print("{}\n", row);
  }
  return {};
}

int run(int count, char** arguments) {
  if (count != 8) {
    fmt::print(stderr,
               "usage: texture_experiment OUT_DIR NAME MESH|- TEXTURE|- POINTS AZ,EL CUTOFF\n");
    return 2;
  }
  Subject subject;
  subject.name = arguments[2];
  subject.points = std::strtoull(arguments[5], nullptr, 10);
  char* rest = nullptr;
  subject.azimuth = std::strtod(arguments[6], &rest);
  subject.elevation = *rest == ',' ? std::strtod(rest + 1, nullptr) : 0.0;
  subject.cutoff = std::strtod(arguments[7], nullptr);
  if (!(subject.cutoff > 0.0)) {
    fmt::print(stderr, "CUTOFF: expected a number above 0, found {}\n", arguments[7]);
    return 2;
  }
  if (std::string(arguments[3]) == "-") {
    make_checkerboard(subject);
  } else {
    Progress progress;
    auto mesh = read_points(arguments[3], progress);
    auto texture = read_image(arguments[4]);
    if (!mesh || !texture) {
      fmt::print(stderr, "{}\n", !mesh ? mesh.error().message : texture.error().message);
      return 1;
    }
    subject.mesh = std::move(mesh->points);
    subject.texture = *std::move(texture);
  }
  if (const Status done = measure(subject, arguments[1]); !done) {
    fmt::print(stderr, "{}\n", done.error().message);
    return 1;
  }
  return 0;
}

}  // namespace
}  // namespace relief::experiment

int main(int count, char** arguments) {
  return relief::experiment::run(count, arguments);
}
