#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "preprocess/gaussians/gaussian_collector.h"
#include "preprocess/gaussians/gaussian_readers.h"
#include "preprocess/gaussians/ply_rows.h"

namespace relief {
namespace {

constexpr std::size_t kChunkGaussians = 256;

constexpr std::string_view kRanges[] = {"min_x",       "min_y",       "min_z",       "max_x",
                                        "max_y",       "max_z",       "min_scale_x", "min_scale_y",
                                        "min_scale_z", "max_scale_x", "max_scale_y", "max_scale_z"};
/// Older files have none; their colours are 0 to 1.
constexpr std::string_view kColourRanges[] = {"min_r", "min_g", "min_b", "max_r", "max_g", "max_b"};
constexpr std::string_view kPacked[] = {"packed_position", "packed_rotation", "packed_scale",
                                        "packed_color"};

struct Range {
  glm::dvec3 min{0.0};
  glm::dvec3 max{1.0};

  [[nodiscard]] glm::dvec3 at(glm::dvec3 share) const { return min * (1.0 - share) + max * share; }
};

struct Chunk {
  Range centres;
  Range log_scales;
  Range colours;
};

/// `bits` bits from bit `begin` on, as a share of the largest.
double share(std::uint32_t packed, unsigned begin, unsigned bits) {
  const std::uint32_t largest = (std::uint32_t{1} << bits) - 1;
  return static_cast<double>(packed >> begin & largest) / largest;
}

glm::dvec3 shares_11_10_11(std::uint32_t packed) {
  return {share(packed, 21, 11), share(packed, 11, 10), share(packed, 0, 11)};
}

glm::dvec3 shares_8_8_8(std::uint32_t packed) {
  return {share(packed, 24, 8), share(packed, 16, 8), share(packed, 8, 8)};
}

/// Three of w x y z in this order, from -sqrt(1/2) to sqrt(1/2), without the largest, whose number
/// is in the first two bits.
glm::dquat unpack_rotation(std::uint32_t packed) {
  const std::uint32_t largest = packed >> 30U;
  std::array<double, 4> wxyz{};
  double rest = 1.0;
  unsigned begin = 30;
  for (std::size_t k = 0; k < 4; ++k) {
    if (k == largest) continue;
    begin -= 10;
    wxyz[k] = (share(packed, begin, 10) - 0.5) * std::numbers::sqrt2;
    rest -= wxyz[k] * wxyz[k];
  }
  wxyz[largest] = std::sqrt(std::max(0.0, rest));
  return {wxyz[0], wxyz[1], wxyz[2], wxyz[3]};
}

/// A byte of the harmonics: -4 to 4, in the middle of its step.
double unpack_harmonic(double byte) {
  if (byte <= 0.0) return -4.0;
  if (byte >= 255.0) return 4.0;
  return ((byte + 0.5) / 256.0 - 0.5) * 8.0;
}

/// Text may have any number there.
std::optional<std::uint32_t> whole(double number) {
  if (!(number >= 0.0 && number <= 4294967295.0)) return std::nullopt;
  return static_cast<std::uint32_t>(number);
}

void set_gaussian(GaussianCollector& gaussians, std::size_t index, const Chunk& chunk,
                  std::span<const double> row) {
  std::array<std::uint32_t, 4> packed{};
  bool is_whole = true;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto bits = whole(row[k]);
    is_whole = is_whole && bits;
    packed[k] = bits.value_or(0);
  }
  constexpr double degree0 = 0.28209479177387814;
  const glm::dvec3 colour = chunk.colours.at(shares_8_8_8(packed[3]));
  gaussians.harmonics(index)[0] = glm::vec3((colour - 0.5) / degree0);
  gaussians.set(index, {.centre = chunk.centres.at(shares_11_10_11(packed[0])),
                        .log_scales = chunk.log_scales.at(shares_11_10_11(packed[2])),
                        .rotation = unpack_rotation(packed[1]),
                        .opacity = is_whole ? share(packed[3], 0, 8)
                                            : std::numeric_limits<double>::quiet_NaN()});
}

Result<std::vector<Chunk>> read_chunks(const Source& source, const PlyHeader& header,
                                       const PlyElement& element) {
  RELIEF_TRY_ASSIGN(PlyRows rows, PlyRows::find(source, header, element));
  const bool has_colours = find_property(element, kColourRanges[0]).has_value();
  for (const std::string_view name : kRanges) RELIEF_TRY(rows.add_column(source, name));
  if (has_colours) {
    for (const std::string_view name : kColourRanges) RELIEF_TRY(rows.add_column(source, name));
  }
  std::vector<Chunk> chunks(rows.count());
  RELIEF_TRY(rows.read(source, [&](std::size_t first, std::span<const double> numbers) {
    const std::size_t columns = has_colours ? 18 : 12;
    for (std::size_t r = 0; r < numbers.size() / columns; ++r) {
      const double* const n = &numbers[r * columns];
      Chunk& chunk = chunks[first + r];
      chunk.centres = {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
      chunk.log_scales = {{n[6], n[7], n[8]}, {n[9], n[10], n[11]}};
      if (has_colours) chunk.colours = {{n[12], n[13], n[14]}, {n[15], n[16], n[17]}};
    }
  }));
  return chunks;
}

Status read_harmonics(const Source& source, PlyRows rows, GaussianCollector& gaussians) {
  const std::size_t rest = gaussians.harmonics(0).size() - 1;
  for (std::size_t k = 0; k < 3 * rest; ++k)
    RELIEF_TRY(rows.add_column(source, fmt::format("f_rest_{}", k)));
  return rows.read(source, [&](std::size_t first, std::span<const double> numbers) {
    for (std::size_t r = 0; r < numbers.size() / (3 * rest); ++r) {
      const double* const n = &numbers[r * 3 * rest];
      const std::span<glm::vec3> harmonics = gaussians.harmonics(first + r);
      for (std::size_t c = 0; c < rest; ++c) {
        harmonics[c + 1] = {unpack_harmonic(n[c]), unpack_harmonic(n[rest + c]),
                            unpack_harmonic(n[2 * rest + c])};
      }
    }
  });
}

}  // namespace

bool has_compressed_gaussians(const PlyHeader& header) {
  const PlyElement* const chunks = find_element(header, "chunk");
  const PlyElement* const vertices = find_element(header, "vertex");
  return chunks != nullptr && vertices != nullptr && find_property(*chunks, kRanges[0]) &&
         find_property(*vertices, kPacked[0]);
}

Result<GaussianCloud> read_compressed_ply(const Source& source, const PlyHeader& header) {
  const PlyElement* const chunk_element = find_element(header, "chunk");
  const PlyElement* const vertices = find_element(header, "vertex");
  const PlyElement* const harmonics = find_element(header, "sh");
  if (chunk_element == nullptr || vertices == nullptr) {
    return make_error("{}: has no elements 'chunk' and 'vertex'", source.name);
  }
  RELIEF_TRY_ASSIGN(PlyRows rows, PlyRows::find(source, header, *vertices));
  for (const std::string_view name : kPacked) RELIEF_TRY(rows.add_column(source, name));
  const std::size_t count = rows.count();
  if (chunk_element->count != (count + kChunkGaussians - 1) / kChunkGaussians) {
    return make_error(
        "{}: has {} chunks for {} Gaussians, but a chunk is for {} of them; the header is damaged",
        source.name, chunk_element->count, count, kChunkGaussians);
  }
  int degree = 0;
  std::optional<PlyRows> harmonics_rows;
  if (harmonics != nullptr) {
    if (harmonics->count != count) {
      return make_error(
          "{}: has harmonics of {} Gaussians, but there are {}; the header is damaged", source.name,
          harmonics->count, count);
    }
    RELIEF_TRY_ASSIGN(degree, find_harmonics_degree(source, *harmonics));
    RELIEF_TRY_ASSIGN(harmonics_rows, PlyRows::find(source, header, *harmonics));
  }
  RELIEF_TRY_ASSIGN(const auto chunks, read_chunks(source, header, *chunk_element));
  GaussianCollector gaussians(count, degree, kRightDownFront);
  if (degree > 0 && count > 0) RELIEF_TRY(read_harmonics(source, *harmonics_rows, gaussians));
  RELIEF_TRY(rows.read(source, [&](std::size_t first, std::span<const double> numbers) {
    for (std::size_t r = 0; r < numbers.size() / 4; ++r) {
      const std::size_t index = first + r;
      set_gaussian(gaussians, index, chunks[index / kChunkGaussians], numbers.subspan(4 * r, 4));
    }
  }));
  return std::move(gaussians).finish(source);
}

}  // namespace relief
