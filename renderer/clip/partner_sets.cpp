#include "renderer/clip/partner_sets.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace relief {
namespace {

/// How elements of a set lie to each other, Eq. (15) and (16).
enum class SetShape : std::uint8_t { Flat, Concave, Convex, Mixed };

/// A set is flat if its middle is nearer to all planes than this share of the splat's radius.
constexpr double kFlat = 0.05;

/// Eq. (15).
SetShape shape_among(const DiscTree& tree, const Disc& splat, std::span<const Partner> partners) {
  glm::dvec3 middle(0.0);
  for (const Partner& partner : partners)
    middle += tree.discs()[partner.slot].centre - splat.centre;
  middle /= static_cast<double>(partners.size());
  bool seen = false;
  bool hidden = false;
  for (const Partner& partner : partners) {
    const Disc& disc = tree.discs()[partner.slot];
    const double height = glm::dot(middle - (disc.centre - splat.centre), disc.normal);
    seen = seen || height > kFlat * splat.radius;
    hidden = hidden || height < -kFlat * splat.radius;
  }
  if (seen && hidden) return SetShape::Mixed;
  return seen ? SetShape::Concave : (hidden ? SetShape::Convex : SetShape::Flat);
}

/// Eq. (16).
SetShape shape_with(std::span<const Partner> partners) {
  const auto seen = std::count_if(partners.begin(), partners.end(),
                                  [](const Partner& partner) { return partner.is_seen; });
  if (seen == 0) return SetShape::Convex;
  return seen == static_cast<std::ptrdiff_t>(partners.size()) ? SetShape::Concave : SetShape::Mixed;
}

}  // namespace

PartnerSets group_partners(const DiscTree& tree, const Disc& splat,
                           std::span<const Partner> partners) {
  PartnerSets sets;
  if (partners.empty()) return sets;
  const SetShape among = shape_among(tree, splat, partners);
  const SetShape with = shape_with(partners);
  const bool intersect = (among == SetShape::Convex && with == SetShape::Concave) ||
                         (among == SetShape::Concave && with == SetShape::Convex);
  sets.groups.resize(intersect ? 1 : partners.size());
  for (std::uint32_t p = 0; p < partners.size(); ++p) sets.groups[intersect ? 0 : p].push_back(p);
  const bool mixed = among == SetShape::Mixed || with == SetShape::Mixed;
  sets.kind = intersect                 ? ClipKind::Intersection
              : mixed                   ? ClipKind::Mixed
              : among == SetShape::Flat ? ClipKind::Flat
                                        : ClipKind::Union;
  return sets;
}

}  // namespace relief
