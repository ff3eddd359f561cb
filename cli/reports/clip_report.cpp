#include "cli/reports/clip_report.h"

#include <fmt/format.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <numeric>

namespace relief::cli {
namespace {

std::size_t splats_of(const ClipCounts& counts) {
  return std::accumulate(counts.kinds.begin(), counts.kinds.end(), std::size_t{0});
}

std::size_t of_kind(const ClipCounts& counts, ClipKind kind) {
  return counts.kinds[static_cast<std::size_t>(kind)];
}

double percent(std::uint64_t part, std::uint64_t all) {
  return all == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(all);
}

}  // namespace

std::string clips_as_text(const ClipCounts& counts) {
  std::string text = fmt::format(
      "  clipping    {} splats: {} flat, {} union, {} intersection, {} mixed, {} not clipped\n"
      "  partners    {} pairs of {} neighbours; threshold {:.3g}\n"
      "  directions  {} differ between Figure 6 and Eq. (18), (19), {:.2g} %\n",
      splats_of(counts), of_kind(counts, ClipKind::Flat), of_kind(counts, ClipKind::Union),
      of_kind(counts, ClipKind::Intersection), of_kind(counts, ClipKind::Mixed),
      of_kind(counts, ClipKind::None), counts.partners / 2, counts.neighbours / 2, counts.threshold,
      counts.disagreements, percent(counts.disagreements, counts.partners));
  if (counts.cut > 0)
    text += fmt::format("  cut         {} splats have more neighbours than are looked at\n",
                        counts.cut);
  return text;
}

nlohmann::ordered_json clips_as_json(const ClipCounts& counts) {
  return {{"splats", splats_of(counts)},
          {"none", of_kind(counts, ClipKind::None)},
          {"flat", of_kind(counts, ClipKind::Flat)},
          {"union", of_kind(counts, ClipKind::Union)},
          {"intersection", of_kind(counts, ClipKind::Intersection)},
          {"mixed", of_kind(counts, ClipKind::Mixed)},
          {"pairs", counts.partners / 2},
          {"neighbour_pairs", counts.neighbours / 2},
          {"threshold", counts.threshold},
          {"disagreements", counts.disagreements},
          {"cut", counts.cut}};
}

}  // namespace relief::cli
