#include "renderer/engines/ewa/splatting.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <span>

#include "renderer/engines/ewa/layered_buffer.h"
#include "renderer/engines/ewa/projected_splat.h"
#include "renderer/engines/ewa/wicke_share.h"

namespace relief::ewa {
namespace {

/// Points that are projected as one piece of work; 2 MB of projected splats.
constexpr std::size_t kChunk = 16384;
/// A tile's fragments are to fit a core's second-level cache: 32 * 32 pixels of 4 are 600 KB.
constexpr std::int64_t kTile = 32;

/// That a splat touches a tile.
struct TileEntry {
  std::uint32_t tile = 0;
  std::uint32_t splat = 0;  ///< in its chunk
};

/// A piece of the cloud, projected.
template <class Kernel>
struct Chunk {
  std::vector<ProjectedSplat<Kernel>> splats;
  std::vector<TileEntry> entries;  ///< by tile, and within a tile in the cloud's order
  std::vector<ImageLine> lines;    ///< of the splats that are clipped

  [[nodiscard]] std::span<const ImageLine> lines_of(const ProjectedSplat<Kernel>& splat) const {
    return std::span(lines).subspan(splat.first_line, splat.line_count);
  }
};

/// The tiles of an image, row by row.
struct Tiling {
  std::int64_t width = 0;  ///< pixels
  std::int64_t height = 0;

  [[nodiscard]] std::int64_t columns() const { return (width + kTile - 1) / kTile; }
  [[nodiscard]] std::int64_t rows() const { return (height + kTile - 1) / kTile; }
  [[nodiscard]] PixelBox all() const { return {0, width - 1, 0, height - 1}; }
  [[nodiscard]] PixelBox tile(std::int64_t t) const {
    const std::int64_t left = t % columns() * kTile;
    const std::int64_t top = t / columns() * kTile;
    return {left, std::min(left + kTile, width) - 1, top, std::min(top + kTile, height) - 1};
  }
};

/// Projects what clips a splat.
template <class Kernel>
void add_lines(const SplatCloud& cloud, const SplatCamera& camera, const Clipping& clipping,
               ProjectedSplat<Kernel>& splat, std::vector<ImageLine>& lines) {
  const std::size_t k = splat.index;
  splat.first_line = static_cast<std::uint32_t>(lines.size());
  project_clip_lines(camera, cloud.positions[k], glm::dvec3(cloud.normals[k]), cloud.radii[k],
                     clipping.partners->of(k), lines);
  splat.line_count = static_cast<std::uint32_t>(lines.size()) - splat.first_line;
  // The lines of Wicke are of all partners, most of them nearly the same.
  if (clipping.rule != ClipRule::Wicke)
    splat.kernel.peak /= kept_mass(clipping.partners->of(k), cloud.radii[k]);
}

template <class Kernel>
Chunk<Kernel> project_chunk(const SplatCloud& cloud, std::size_t begin, std::size_t end,
                            const SplatCamera& camera, const Tiling& tiling,
                            const Clipping& clipping) {
  Chunk<Kernel> chunk;
  chunk.splats.reserve(end - begin);
  for (std::size_t k = begin; k < end; ++k) {
    auto splat = project_splat<Kernel>(camera, cloud.positions[k], glm::dvec3(cloud.normals[k]),
                                       cloud.radii[k]);
    if (!splat) continue;
    const PixelBox box = pixels_of(splat->kernel, tiling.all());
    if (box.empty()) continue;
    splat->index = static_cast<std::uint32_t>(k);
    if (clipping.partners != nullptr) add_lines(cloud, camera, clipping, *splat, chunk.lines);
    const auto slot = static_cast<std::uint32_t>(chunk.splats.size());
    chunk.splats.push_back(*splat);
    for (std::int64_t row = box.top / kTile; row <= box.bottom / kTile; ++row) {
      for (std::int64_t column = box.left / kTile; column <= box.right / kTile; ++column)
        chunk.entries.push_back(
            {static_cast<std::uint32_t>(row * tiling.columns() + column), slot});
    }
  }
  std::stable_sort(chunk.entries.begin(), chunk.entries.end(),
                   [](const TileEntry& a, const TileEntry& b) { return a.tile < b.tile; });
  return chunk;
}

/// What a caller left undefined does not spread over the image.
template <class Vector>
Vector finite_or_zero(Vector v) {
  for (glm::length_t i = 0; i < Vector::length(); ++i) v[i] = std::isfinite(v[i]) ? v[i] : 0.0;
  return v;
}

/// The direction in which a position is seen, of any length.
glm::dvec3 ray_to(const View& view, glm::dvec3 position) {
  if (view.orthographic) return glm::transpose(view.rotation) * glm::dvec3(0.0, 0.0, -1.0);
  return position - view.eye;
}

SplatAttributes attributes_of(const SplatCloud& cloud, const Lighting& lighting, const View& view,
                              const Clipping& clipping, std::size_t k) {
  SplatAttributes attributes;
  attributes.colour = cloud.colours.empty()
                          ? glm::dvec4(glm::dvec3(double{shared::kNeutralGrey}), 1.0)
                          : finite_or_zero(glm::dvec4(cloud.colours[k]));
  attributes.colour.a = std::clamp(attributes.colour.a, 0.0, 1.0);
  attributes.normal = glm::normalize(glm::dvec3(cloud.normals[k]));
  if (!cloud.uvs.empty()) attributes.uv = finite_or_zero(glm::dvec2(cloud.uvs[k]));
  if (!cloud.patches.empty()) attributes.patch = cloud.patches[k];
  if (!cloud.materials.empty()) attributes.material = cloud.materials[k];
  attributes.faces_away = glm::dot(attributes.normal, ray_to(view, cloud.positions[k])) > 0.0;
  if (clipping.partners != nullptr)
    attributes.clip = static_cast<std::uint8_t>(clipping.partners->kinds[k]);
  attributes.colour.a *= double{material_of(lighting, attributes.material).constants.opacity};
  return attributes;
}

/// What pixels keep of a splat.
struct SplatShare {
  std::span<const ImageLine> lines;
  const View& view;
  std::optional<WickeSplat> wicke;

  [[nodiscard]] KeptShare kept(glm::dvec2 pixel, glm::dvec2 offset) const {
    if (lines.empty()) return {};
    return wicke ? wicke_share(*wicke, lines, view, pixel, offset) : kept_share(lines, offset);
  }
};

SplatShare share_of(const SplatCloud& cloud, const Clipping& clipping, const View& view,
                    std::span<const ImageLine> lines, std::size_t k) {
  if (lines.empty() || clipping.rule != ClipRule::Wicke) return {lines, view, std::nullopt};
  return {lines, view,
          WickeSplat{cloud.positions[k], glm::normalize(glm::dvec3(cloud.normals[k])),
                     clipping.partners->planes_of(k)}};
}

/// Adds a splat to the pixels of a tile; returns how many its kernel reaches.
template <class Kernel>
std::uint64_t draw_splat(const ProjectedSplat<Kernel>& splat, const SplatShare& share,
                         double cutoff, const SplatAttributes& attributes, const PixelBox& tile,
                         LayeredBuffer& buffer) {
  const Kernel& kernel = splat.kernel;
  const PixelBox box = pixels_of(kernel, tile);
  std::uint64_t reached = 0;
  for (std::int64_t y = box.top; y <= box.bottom; ++y) {
    for (std::int64_t x = box.left; x <= box.right; ++x) {
      const glm::dvec2 middle(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
      const double exponent = kernel.exponent(middle);
      if (!(exponent < cutoff)) continue;
      const glm::dvec2 offset = middle - kernel.centre;
      const KeptShare kept = share.kept(middle, offset);
      if (!(kept.share > 0.0)) continue;
      const double whole = kernel.peak * std::exp(-exponent);
      const Contribution contribution{kept.share * whole, splat.depth.at(offset),
                                      splat.depth.threshold, (1.0 - kept.share) * whole,
                                      kept.beyond};
      const auto pixel = static_cast<std::size_t>((y - tile.top) * kTile + (x - tile.left));
      buffer.add(pixel, contribution, attributes);
      ++reached;
    }
  }
  return reached;
}

FilmPixel film_pixel(const ResolvedPixel& resolved) {
  FilmPixel pixel;
  if (!(resolved.colour.a > 0.0)) return pixel;
  pixel.colour = glm::vec4(resolved.colour);
  pixel.normal = glm::vec3(resolved.normal);
  pixel.depth = static_cast<float>(resolved.depth);
  pixel.uv = glm::vec2(resolved.uv);
  pixel.patch = resolved.patch;
  pixel.clip = resolved.clip;
  return pixel;
}

/// The entries of a tile.
template <class Kernel>
std::span<const TileEntry> entries_of(const Chunk<Kernel>& chunk, std::uint32_t tile) {
  const auto [first, last] =
      std::equal_range(chunk.entries.begin(), chunk.entries.end(), TileEntry{tile, 0},
                       [](const TileEntry& a, const TileEntry& b) { return a.tile < b.tile; });
  return {first, last};
}

/// Draws a tile into the film; returns the evaluations.
template <class Kernel>
std::uint64_t draw_tile(const SplatCloud& cloud, const std::vector<Chunk<Kernel>>& chunks,
                        std::uint32_t t, const PixelBox& tile, const View& view,
                        const EwaSettings& settings, const Lighting& lighting,
                        const Clipping& clipping, Film& film) {
  const bool empty = std::all_of(chunks.begin(), chunks.end(), [t](const Chunk<Kernel>& chunk) {
    return entries_of(chunk, t).empty();
  });
  if (empty) return 0;
  const auto shade = [&](const Surface& surface) {
    const auto pixel = static_cast<std::int64_t>(surface.pixel);
    const glm::dvec2 pixel_corner(tile.left + pixel % kTile, tile.top + pixel / kTile);
    return shade_surface(surface, pixel_corner + 0.5, view, lighting);
  };
  LayeredBuffer buffer(static_cast<std::size_t>(kTile), static_cast<std::size_t>(kTile),
                       settings.layers, settings.coverage_threshold, shade);
  std::uint64_t evaluations = 0;
  for (const Chunk<Kernel>& chunk : chunks) {
    for (const TileEntry& entry : entries_of(chunk, t)) {
      const ProjectedSplat<Kernel>& splat = chunk.splats[entry.splat];
      evaluations +=
          draw_splat(splat, share_of(cloud, clipping, view, chunk.lines_of(splat), splat.index),
                     settings.cutoff, attributes_of(cloud, lighting, view, clipping, splat.index),
                     tile, buffer);
    }
  }
  for (std::int64_t y = tile.top; y <= tile.bottom; ++y) {
    for (std::int64_t x = tile.left; x <= tile.right; ++x) {
      const auto pixel = static_cast<std::size_t>((y - tile.top) * kTile + (x - tile.left));
      film.pixels[static_cast<std::size_t>(y * film.width + x)] = film_pixel(buffer.resolve(pixel));
    }
  }
  return evaluations;
}

template <class Kernel>
Splatted splat_with(const SplatCloud& cloud, const View& view, const EwaSettings& settings,
                    const Lighting& lighting, const Progress& progress, const Clipping& clipping) {
  const SplatCamera camera = make_splat_camera(view, settings);
  const Tiling tiling{view.width, view.height};
  const std::size_t points = cloud.positions.size();
  std::vector<Chunk<Kernel>> chunks((points + kChunk - 1) / kChunk);
  tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
    if (progress.cancelled()) return;
    chunks[c] = project_chunk<Kernel>(cloud, c * kChunk, std::min((c + 1) * kChunk, points), camera,
                                      tiling, clipping);
  });
  Splatted splatted;
  splatted.film = {view.width, view.height,
                   std::vector<FilmPixel>(std::size_t{view.width} * view.height)};
  std::vector<std::uint64_t> evaluations(static_cast<std::size_t>(tiling.columns() * tiling.rows()),
                                         0);
  tbb::parallel_for(std::size_t{0}, evaluations.size(), [&](std::size_t t) {
    if (progress.cancelled()) return;
    evaluations[t] = draw_tile(cloud, chunks, static_cast<std::uint32_t>(t),
                               tiling.tile(static_cast<std::int64_t>(t)), view, settings, lighting,
                               clipping, splatted.film);
  });
  for (const std::uint64_t count : evaluations) splatted.evaluations += count;
  return splatted;
}

}  // namespace

Splatted splat_cloud(const SplatCloud& cloud, const View& view, const EwaSettings& settings,
                     const Lighting& lighting, const Progress& progress, const Clipping& clipping) {
  assert(cloud.normals.size() == cloud.positions.size() &&
         cloud.radii.size() == cloud.positions.size() && !lighting.materials.empty() &&
         "a cloud as its type says");
  return settings.filter == EwaFilter::SourceSpace
             ? splat_with<SourceKernel>(cloud, view, settings, lighting, progress, clipping)
             : splat_with<ScreenKernel>(cloud, view, settings, lighting, progress, clipping);
}

}  // namespace relief::ewa
