#include <array>
#include <cmath>

#include "preprocess/gaussians/gaussian_collector.h"
#include "preprocess/gaussians/gaussian_readers.h"
#include "preprocess/gaussians/ply_rows.h"

namespace relief {
namespace {

/// Those before the other harmonics, in the order in which they are read.
constexpr std::string_view kProperties[] = {"x",       "y",      "z",      "scale_0", "scale_1",
                                            "scale_2", "rot_0",  "rot_1",  "rot_2",   "rot_3",
                                            "opacity", "f_dc_0", "f_dc_1", "f_dc_2"};
constexpr std::size_t kRest = std::size(kProperties);

double opacity_of(double logit) {
  return 1.0 / (1.0 + std::exp(-logit));
}

void set_gaussian(GaussianCollector& gaussians, std::size_t index, std::span<const double> row) {
  const std::span<glm::vec3> harmonics = gaussians.harmonics(index);
  harmonics[0] = glm::vec3(row[11], row[12], row[13]);
  const std::size_t rest = harmonics.size() - 1;
  for (std::size_t c = 0; c < rest; ++c) {
    harmonics[c + 1] = glm::vec3(row[kRest + c], row[kRest + rest + c], row[kRest + 2 * rest + c]);
  }
  gaussians.set(index, {.centre = {row[0], row[1], row[2]},
                        .log_scales = {row[3], row[4], row[5]},
                        .rotation = glm::dquat(row[6], row[7], row[8], row[9]),
                        .opacity = opacity_of(row[10])});
}

}  // namespace

bool has_plain_gaussians(const PlyHeader& header) {
  const PlyElement* const vertices = find_element(header, "vertex");
  if (vertices == nullptr) return false;
  for (const std::string_view name : {"f_dc_0", "opacity", "scale_0", "rot_0"}) {
    if (!find_property(*vertices, name)) return false;
  }
  return true;
}

Result<GaussianCloud> read_gaussian_ply(const Source& source, const PlyHeader& header) {
  const PlyElement* const vertices = find_element(header, "vertex");
  if (vertices == nullptr) return make_error("{}: has no elements 'vertex'", source.name);
  RELIEF_TRY_ASSIGN(PlyRows rows, PlyRows::find(source, header, *vertices));
  RELIEF_TRY_ASSIGN(const int degree, find_harmonics_degree(source, *vertices));
  for (const std::string_view name : kProperties) RELIEF_TRY(rows.add_column(source, name));
  const std::size_t rest = 3 * (harmonics_of(degree) - 1);
  for (std::size_t k = 0; k < rest; ++k)
    RELIEF_TRY(rows.add_column(source, fmt::format("f_rest_{}", k)));
  GaussianCollector gaussians(rows.count(), degree, kRightDownFront);
  RELIEF_TRY(rows.read(source, [&](std::size_t first, std::span<const double> numbers) {
    const std::size_t columns = kRest + rest;
    for (std::size_t r = 0; r < numbers.size() / columns; ++r)
      set_gaussian(gaussians, first + r, numbers.subspan(r * columns, columns));
  }));
  return std::move(gaussians).finish(source);
}

}  // namespace relief
