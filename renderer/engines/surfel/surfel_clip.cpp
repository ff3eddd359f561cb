#include "renderer/engines/surfel/surfel_clip.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <utility>

#include "renderer/clip/clip_partners.h"
#include "renderer/frame/clip_texels.h"
#include "shaders/include/shared.h"

namespace relief::surfel {
namespace {

SplatDiscs discs_of(const SurfelSet& set) {
  SplatDiscs discs;
  const auto own = static_cast<std::ptrdiff_t>(set.own);
  discs.centres.assign(set.positions.begin(), set.positions.begin() + own);
  discs.normals.assign(set.normals.begin(), set.normals.begin() + own);
  discs.radii.assign(set.radii.begin(), set.radii.begin() + own);
  return discs;
}

/// A vector of the world in the frame of a surfel's disc of radius 1.
glm::vec3 in_disc(glm::vec3 v, const SurfelSet& set, std::size_t slot) {
  const float radius = set.radii[slot];
  const glm::vec3 across(glm::dot(v, set.axes[slot].u), glm::dot(v, set.axes[slot].v),
                         radius * glm::dot(v, set.normals[slot]));
  return across / (radius * radius);
}

/// The line's direction stays a unit vector, so that its offset is in radii.
glm::vec4 line_in_disc(const ClipLine& line, const SurfelSet& set, std::size_t slot) {
  const float radius = set.radii[slot];
  return {radius * glm::vec2(in_disc(line.direction, set, slot)), line.offset / radius,
          line.ends_group ? 1.0F : 0.0F};
}

/// The plane of a line's partner in the disc's frame.
void add_plane(const PartnerPlane& plane, const SurfelSet& set, std::size_t slot,
               std::vector<glm::vec4>& texels) {
  texels.emplace_back(in_disc(plane.centre, set, slot), plane.edge_is_concave ? 1.0F : 0.0F);
  texels.emplace_back(set.radii[slot] * in_disc(plane.normal, set, slot), 0.0F);
}

}  // namespace

Result<SurfelClip> make_surfel_clip(const Gl& gl, const SurfelSet& set,
                                    const ClipSettings& settings, Progress& progress) {
  RELIEF_TRY_ASSIGN(const ClipPartners partners,
                    find_clip_partners(discs_of(set), settings, progress));
  std::vector<glm::uvec2> ranges;
  std::vector<glm::vec4> lines;
  std::vector<std::uint8_t> clipped;
  for (std::size_t slot = 0; slot < set.own; ++slot) {
    const std::span<const ClipLine> own = partners.of(slot);
    ranges.push_back(clip_range(lines.size(), own.size(), partners.kinds[slot]));
    for (std::size_t l = 0; l < own.size(); ++l) {
      lines.push_back(line_in_disc(own[l], set, slot));
      if (!partners.planes.empty()) add_plane(partners.planes_of(slot)[l], set, slot, lines);
    }
    clipped.push_back(own.empty() ? 0 : 1);
  }
  ranges.resize(set.points.size(), glm::uvec2(0));  // mean surfels are not clipped
  RELIEF_TRY_ASSIGN(Table table, make_clip_lines(gl, lines));
  SurfelClip clip{make_table(gl, "clip ranges", GL_RG32UI, std::span<const glm::uvec2>(ranges)),
                  std::move(table), std::move(clipped)};
  RELIEF_TRY(check_errors(gl, "the clip lines"));
  return clip;
}

}  // namespace relief::surfel
