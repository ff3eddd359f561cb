// The classification of clip partners, stage by stage.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/clip/clip_partners.h"
#include "renderer/clip/different_surface.h"
#include "renderer/clip/disc_tree.h"
#include "renderer/clip/partner_sets.h"
#include "renderer/clip/partners.h"
#include "renderer/clip/plane_line.h"

namespace relief {
namespace {

/// Discs that are clipped as one piece of work.
constexpr std::size_t kPiece = 512;
/// Neighbours of a splat that are tested. Splats of one spacing have about 30, one among others a
/// tenth as large 1500; the others find it as well.
constexpr std::size_t kTested = 4096;
/// Partners of a splat, and of all splats together (512 MB).
constexpr std::size_t kPartners = 1024;
constexpr std::size_t kAllPartners = std::size_t{1} << 27U;
/// What changes a disc by less than this share of its radius is no line.
constexpr double kTolerance = 1e-4;

/// The frame of a splat's plane: its axes and how far it reaches along them.
struct Frame {
  glm::dvec3 x;
  glm::dvec3 y;
  double along_x;
  double along_y;
};

Frame frame_of(const SplatDiscs& discs, const Disc& disc) {
  if (!discs.major_axes.empty()) {
    const glm::dvec3 major = discs.major_axes[disc.splat];
    return {major, glm::cross(disc.normal, major), disc.radius, discs.minor_radii[disc.splat]};
  }
  const glm::dvec3 other =
      std::abs(disc.normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 x = glm::normalize(glm::cross(other, disc.normal));
  return {x, glm::cross(disc.normal, x), disc.radius, disc.radius};
}

/// The border of the area that a partner clips: the side of the line where the splat's centre is
/// not (Figure 6). If the centre is on the line, Eq. (18) and (19) decide.
PlaneLine line_of(const Frame& frame, const Disc& splat, const Disc& other, const Partner& partner,
                  std::uint32_t number) {
  const double towards = glm::dot(partner.line.origin, other.normal);
  const double cosine = glm::dot(splat.normal, other.normal);
  glm::dvec3 direction = glm::normalize(other.normal - cosine * splat.normal);
  // The partner sees what is along its normal; the line's distance from the centre along it is
  // `distance`.
  const double distance = glm::dot(partner.line.origin, direction);
  const bool flip = towards != 0.0 ? towards < 0.0 : partner.is_seen;
  if (flip) direction = -direction;
  return {{glm::dot(direction, frame.x), glm::dot(direction, frame.y)}, std::abs(distance), number};
}

/// The lines of some splats, and where each splat's end.
struct Piece {
  std::vector<ClipLine> lines;
  std::vector<std::uint32_t> ends;
};

}  // namespace

Result<ClipPartners> find_clip_partners(const SplatDiscs& discs, const ClipSettings& settings,
                                        Progress& progress) {
  ClipPartners result;
  result.first.assign(discs.centres.size() + 1, 0);
  result.kinds.assign(discs.centres.size(), ClipKind::None);
  if (settings.rule == ClipRule::Off) return result;
  const DiscTree tree(discs);
  if (tree.discs().empty()) return result;
  const std::size_t count = tree.discs().size();
  progress.begin_stage("clip partners", 2 * count);
  const SurfaceTest test = surface_test(tree, settings);
  const PartnerLimits limits{kTested, std::clamp(kAllPartners / count, std::size_t{32}, kPartners)};
  RELIEF_TRY_ASSIGN(const PartnerLists lists, find_partners(discs, tree, test, limits, progress));

  std::vector<std::vector<ClipLine>> lines(discs.centres.size());
  tbb::parallel_for(std::size_t{0}, (count + kPiece - 1) / kPiece, [&](std::size_t p) {
    std::vector<Partner> partners;
    const std::size_t end = std::min((p + 1) * kPiece, count);
    for (std::size_t slot = p * kPiece; slot < end && !progress.cancelled(); ++slot) {
      const Disc& splat = tree.discs()[slot];
      partners.clear();
      for (const std::uint32_t other : lists.of(slot))
        if (const auto partner = as_partner(discs, test, splat, tree.discs()[other], other))
          partners.push_back(*partner);
      if (settings.rule == ClipRule::Nearest && partners.size() > 1) partners.resize(1);
      PartnerSets sets = group_partners(tree, splat, partners);
      if (settings.rule == ClipRule::Independent && sets.groups.size() == 1) {
        sets.groups.resize(partners.size());
        for (std::uint32_t k = 0; k < partners.size(); ++k) sets.groups[k] = {k};
      }
      const Frame frame = frame_of(discs, splat);
      std::vector<std::vector<PlaneLine>> groups;
      for (const auto& group : sets.groups) {
        groups.emplace_back();
        for (const std::uint32_t k : group)
          groups.back().push_back(
              line_of(frame, splat, tree.discs()[partners[k].slot], partners[k], k));
      }
      keep_bounding_lines(groups, frame.along_x, frame.along_y, kTolerance * splat.radius);
      result.kinds[splat.splat] = sets.kind;
      for (const auto& group : groups)
        for (const PlaneLine& line : group)
          lines[splat.splat].push_back(
              {glm::vec3(line.direction.x * frame.x + line.direction.y * frame.y),
               static_cast<float>(line.offset), tree.discs()[partners[line.partner].slot].splat,
               &line == &group.back()});
    }
    progress.advance(end - p * kPiece);
  });
  if (progress.cancelled()) return interrupted_error();
  for (std::size_t s = 0; s < lines.size(); ++s) {
    result.lines.insert(result.lines.end(), lines[s].begin(), lines[s].end());
    result.first[s + 1] = static_cast<std::uint32_t>(result.lines.size());
  }
  return result;
}

}  // namespace relief
