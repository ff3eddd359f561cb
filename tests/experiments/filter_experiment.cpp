// Measures [Zwicker 2001], Figure 8: the filters of the engine `ewa` on a checkerboard plane, from
// grazing to magnified, against the truth of 1024 rays a pixel.
// usage: filter_experiment OUT_DIR
// Prints Markdown tables (PSNR in dB / FLIP) and writes OUT_DIR/filter_VIEW_WAY.png.
#include <fmt/format.h>

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "common/image/image_io.h"
#include "tests/experiments/checkerboard_plane.h"
#include "tests/experiments/draw_unlit.h"

namespace relief::experiment {
namespace {

constexpr std::uint32_t kSide = 256;

const std::vector<PlaneView>& views() {
  static const std::vector<PlaneView> all = {
      {"grazing70", 70.0, 1.0},  {"grazing80", 80.0, 1.5},  {"grazing85", 85.0, 1.5},
      {"tilted60x8", 60.0, 8.0}, {"tilted60x2", 60.0, 2.0}, {"tilted60x05", 60.0, 0.5},
      {"frontal16", 0.0, 16.0},  {"frontal4", 0.0, 4.0},    {"frontal2", 0.0, 2.0},
      {"frontal1", 0.0, 1.0},    {"frontal05", 0.0, 0.5},   {"frontal025", 0.0, 0.25},
  };
  return all;
}

constexpr std::array<std::pair<const char*, EwaFilter>, 4> kFilters = {
    {{"ewa", EwaFilter::Ewa},
     {"source-space", EwaFilter::SourceSpace},
     {"circular", EwaFilter::Circular},
     {"unfiltered", EwaFilter::Unfiltered}}};
/// The paper's cutoff, and one that cuts nothing off that could be seen.
constexpr double kCutoff = 1.0;
constexpr double kNoCutoff = 8.0;

/// A view with everything that was drawn and traced of it.
struct Subject {
  PlaneView view;
  PlaneTruths truths;
  std::vector<Mapping> mappings;
  std::vector<Image> cut;    ///< images by kFilters with kCutoff
  std::vector<Image> uncut;  ///< with kNoCutoff
};

Result<Image> draw(const SplatCloud& cloud, const Camera& camera, EwaFilter filter, double cutoff) {
  EwaSettings ewa;
  ewa.filter = filter;
  ewa.cutoff = cutoff;
  return draw_unlit(cloud, camera, kSide, ewa);
}

Result<Subject> make_subject(const PlaneView& view, const std::string& out) {
  Subject subject{view, plane_truths(view, kSide), find_mappings(view, kSide), {}, {}};
  const auto write = [&](const std::string& name, const Image& image) {
    return write_png(fmt::format("{}/filter_{}_{}.png", out, view.name, name), image);
  };
  Status written = write("truth", subject.truths.checkerboard.box.image);
  if (!written) return written.error();
  const SplatCloud cloud = plane_points(view, kSide);
  const Camera camera = camera_of(view, kSide);
  for (const auto& [name, filter] : kFilters) {
    auto cut = draw(cloud, camera, filter, kCutoff);
    auto uncut = draw(cloud, camera, filter, kNoCutoff);
    if (!cut || !uncut) return !cut ? cut.error() : uncut.error();
    written = write(name, *cut);
    if (!written) return written.error();
    subject.cut.push_back(*std::move(cut));
    subject.uncut.push_back(*std::move(uncut));
  }
  return subject;
}

/// Some pixels of a view.
struct Region {
  std::string name;
  Mask mask;
};

/// The whole view, and where it has more than one of them, the mappings.
std::vector<Region> regions_of(const Subject& subject) {
  const Mask covered = subject.truths.checkerboard.gaussian.covered();
  std::vector<Region> regions{{"all", covered}};
  if (subject.view.inclination == 0.0) return regions;
  constexpr std::array<std::pair<Mapping, const char*>, 3> kParts = {
      {{Mapping::Magnified, "magnified"},
       {Mapping::Anisotropic, "anisotropic"},
       {Mapping::Minified, "minified"}}};
  for (const auto& [mapping, name] : kParts) {
    Region part{name, covered};
    std::size_t count = 0;
    for (std::size_t i = 0; i < covered.size(); ++i) {
      if (subject.mappings[i] != mapping) part.mask[i] = 0;
      count += part.mask[i];
    }
    // Fewer pixels than FLIP's filters are wide say nothing.
    if (count >= 1000) regions.push_back(std::move(part));
  }
  if (regions.size() == 2) return {{regions[1].name, std::move(regions[1].mask)}};
  return regions;
}

/// A column of a table: an image of each view.
struct Column {
  std::string name;
  std::function<const Image&(const Subject&)> image;
};

std::vector<Column> columns_of(std::vector<Image> Subject::*images) {
  std::vector<Column> columns;
  for (std::size_t i = 0; i < kFilters.size(); ++i) {
    columns.push_back({kFilters[i].first, [images, i](const Subject& subject) -> const Image& {
                         return (subject.*images)[i];
                       }});
  }
  return columns;
}

void print_table(const std::vector<Subject>& subjects, const char* title,
                 const std::vector<Column>& columns,
                 const std::function<const Truth&(const PlaneTruths&)>& truth_of) {
  fmt::print("\n{}\n\n| view | region |", title);
  for (const Column& column : columns) fmt::print(" {} |", column.name);
  fmt::print("\n| --- | --- |");
  for (std::size_t i = 0; i < columns.size(); ++i) fmt::print(" ---: |");
  fmt::print("\n");
  for (const Subject& subject : subjects) {
    const Image& truth = truth_of(subject.truths).image;
    for (const Region& region : regions_of(subject)) {
      fmt::print("| {} | {} |", subject.view.name, region.name);
      for (const Column& column : columns)
        fmt::print(" {} |", as_cell(measure_error(column.image(subject), truth, region.mask)));
      fmt::print("\n");
    }
  }
}

/// Pixels that the plane covers wholly and an image leaves transparent.
std::size_t count_gaps(const std::vector<Subject>& subjects) {
  std::size_t gaps = 0;
  for (const Subject& subject : subjects) {
    const Mask covered = subject.truths.checkerboard.gaussian.covered();
    for (const Image& image : subject.cut) {
      const Channel* const alpha = image.find("A");
      for (std::size_t i = 0; alpha != nullptr && i < covered.size(); ++i)
        gaps += covered[i] != 0 && alpha->values[i] < 1.0F ? 1 : 0;
    }
  }
  return gaps;
}

void print_tables(const std::vector<Subject>& subjects) {
  auto columns = columns_of(&Subject::cut);
  const auto gaussian = [](const PlaneTruths& t) -> const Truth& {
    return t.checkerboard.gaussian;
  };
  columns.push_back({"ewa, cutoff 8",
                     [](const Subject& subject) -> const Image& { return subject.uncut.front(); }});
  columns.push_back({"Gaussian truth", [&](const Subject& subject) -> const Image& {
                       return gaussian(subject.truths).image;
                     }});
  print_table(subjects, "Checkerboard, box, cutoff 1", columns,
              [](const PlaneTruths& t) -> const Truth& { return t.checkerboard.box; });
  columns.resize(kFilters.size());
  print_table(subjects, "Checkerboard, Gaussian, cutoff 1", columns, gaussian);
  columns = columns_of(&Subject::uncut);
  columns.push_back({"ewa, cutoff 1",
                     [](const Subject& subject) -> const Image& { return subject.cut.front(); }});
  print_table(subjects, "Function on the splats, Gaussian, cutoff 8", columns,
              [](const PlaneTruths& t) -> const Truth& { return t.splats.gaussian; });
  fmt::print("\ncovered pixels left transparent at cutoff 1: {}\n", count_gaps(subjects));
}

int run(int count, char** arguments) {
  if (count != 2) {
    fmt::print(stderr, "usage: filter_experiment OUT_DIR\n");
    return 2;
  }
  std::vector<Subject> subjects;
  for (const PlaneView& view : views()) {
    auto subject = make_subject(view, arguments[1]);
    if (!subject) {
      fmt::print(stderr, "{}\n", subject.error().message);
      return 1;
    }
    subjects.push_back(*std::move(subject));
  }
  print_tables(subjects);
  return 0;
}

}  // namespace
}  // namespace relief::experiment

int main(int count, char** arguments) {
  return relief::experiment::run(count, arguments);
}
