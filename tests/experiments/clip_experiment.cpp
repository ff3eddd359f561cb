// Clips discs on solids whose surface is known, and measures what is left over and what is lost.
// docs/measurements/clip-partners.md has the figures.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <random>
#include <string>
#include <unordered_map>

#include "renderer/clip/clip_partners.h"
#include "renderer/clip/wicke.h"
#include "tests/experiments/clip_models.h"

namespace relief::experiment {
namespace {

/// Radius of a disc over the spacing: even points cover the surface from 1 on.
constexpr double kRadius = 1.2;
/// What is nearer to the surface than this share of the radius is on it.
constexpr double kTolerance = 0.1;
constexpr int kSamplesAcross = 24;

struct Errors {
  double over_air = 0.0;    ///< share of the area of discs at edges that hangs over in air
  double over_solid = 0.0;  ///< the same in the solid
  double holes = 0.0;       ///< share of the surface at edges that only clipped discs leave bare
};

struct Setup {
  SplatDiscs discs;
  std::vector<std::uint32_t> faces;
  std::vector<SurfacePoint> probes;
};

Setup set_up(const SharpModel& model, double spacing, double noise) {
  Setup setup;
  std::mt19937_64 random(7);
  std::normal_distribution<double> gauss;
  for (const SurfacePoint& point : even_points(model, spacing, 1)) {
    glm::dvec3 normal = point.normal;
    if (noise > 0.0)
      normal = glm::normalize(normal + std::tan(noise) *
                                           glm::dvec3(gauss(random), gauss(random), gauss(random)));
    setup.discs.centres.push_back(point.position);
    setup.discs.normals.push_back(normal);
    setup.discs.radii.push_back(kRadius * spacing * model.faces[point.face].coarseness);
    setup.faces.push_back(point.face);
  }
  setup.probes = random_points(model, 200000, 2);
  return setup;
}

class Clipped {
 public:
  Clipped(const SplatDiscs& discs, ClipSettings settings) : discs_(discs), rule_(settings.rule) {
    Progress progress;
    partners_ = *find_clip_partners(discs, settings, progress);
  }
  [[nodiscard]] bool keeps(std::size_t splat, glm::dvec3 offset) const {
    const auto lines = partners_.of(splat);
    if (lines.empty()) return true;
    return rule_ == ClipRule::Wicke
               ? !wicke_clips(lines, partners_.planes_of(splat), glm::vec3(offset))
               : !is_clipped(lines, glm::vec3(offset));
  }
  [[nodiscard]] const ClipPartners& partners() const { return partners_; }

 private:
  const SplatDiscs& discs_;
  ClipRule rule_;
  ClipPartners partners_;
};

/// Discs by cells as large as the largest disc.
class DiscGrid {
 public:
  explicit DiscGrid(const SplatDiscs& discs) : discs_(discs) {
    for (const double radius : discs.radii) cell_ = std::max(cell_, 2.0 * radius);
    for (std::uint32_t s = 0; s < discs.centres.size(); ++s) {
      const glm::dvec3 p = discs.centres[s] / cell_;
      for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
          for (int z = -1; z <= 1; ++z) cells_[key(p + glm::dvec3(x, y, z))].push_back(s);
    }
  }
  [[nodiscard]] const std::vector<std::uint32_t>& near(glm::dvec3 p) const {
    static const std::vector<std::uint32_t> none;
    const auto found = cells_.find(key(p / cell_));
    return found == cells_.end() ? none : found->second;
  }

 private:
  static std::uint64_t key(glm::dvec3 p) {
    const auto part = [](double x) {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(x)) + 1000000);
    };
    return (part(p.x) << 42U) | (part(p.y) << 21U) | part(p.z);
  }
  const SplatDiscs& discs_;
  double cell_ = 0.0;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

/// Whether a ray along the probe's normal meets the disc near the probe; where, from the centre.
bool covers(const SplatDiscs& discs, std::size_t s, const SurfacePoint& probe, glm::dvec3& offset) {
  const double slope = glm::dot(discs.normals[s], probe.normal);
  if (slope < 0.2) return false;
  const glm::dvec3 from = probe.position - discs.centres[s];
  const double along = -glm::dot(from, discs.normals[s]) / slope;
  offset = from + along * probe.normal;
  return std::abs(along) < 2.0 * kTolerance * discs.radii[s] &&
         glm::dot(offset, offset) < discs.radii[s] * discs.radii[s];
}

std::vector<Errors> measure(const SharpModel& model, const Setup& setup,
                            const std::vector<Clipped>& rules, const std::vector<bool>& at_edge) {
  const SplatDiscs& discs = setup.discs;
  std::vector<Errors> errors(rules.size());
  double samples = 0.0;
  for (std::size_t s = 0; s < discs.centres.size(); ++s) {
    if (!at_edge[s]) continue;
    const glm::dvec3 n = discs.normals[s];
    const glm::dvec3 x = glm::normalize(
        glm::cross(std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0), n));
    const glm::dvec3 y = glm::cross(n, x);
    for (int i = 0; i < kSamplesAcross; ++i) {
      for (int j = 0; j < kSamplesAcross; ++j) {
        const glm::dvec2 unit = 2.0 * (glm::dvec2(i, j) + 0.5) / double{kSamplesAcross} - 1.0;
        if (glm::dot(unit, unit) > 1.0) continue;
        samples += discs.radii[s] * discs.radii[s];
        const glm::dvec3 offset = discs.radii[s] * (unit.x * x + unit.y * y);
        const double height = model.height(discs.centres[s] + offset) / discs.radii[s];
        if (std::abs(height) < kTolerance) continue;
        for (std::size_t r = 0; r < rules.size(); ++r)
          if (rules[r].keeps(s, offset))
            (height > 0.0 ? errors[r].over_air : errors[r].over_solid) +=
                discs.radii[s] * discs.radii[s];
      }
    }
  }
  const DiscGrid grid(discs);
  std::vector<std::uint8_t> covered(rules.size());
  double probes = 0.0;
  for (const SurfacePoint& probe : setup.probes) {
    std::fill(covered.begin(), covered.end(), 0);
    bool edge = false;
    bool any = false;
    for (const std::uint32_t s : grid.near(probe.position)) {
      glm::dvec3 offset;
      if (!covers(discs, s, probe, offset)) continue;
      any = true;
      edge = edge || at_edge[s];
      for (std::size_t r = 0; r < rules.size(); ++r)
        if (covered[r] == 0 && rules[r].keeps(s, offset)) covered[r] = 1;
    }
    if (!any || !edge) continue;
    probes += 1.0;
    for (std::size_t r = 0; r < rules.size(); ++r)
      if (covered[r] == 0) errors[r].holes += 1.0;
  }
  for (Errors& error : errors) {
    error.over_air *= 100.0 / samples;
    error.over_solid *= 100.0 / samples;
    error.holes *= 100.0 / probes;
  }
  return errors;
}

int run(double spacing, double noise_degrees, bool refit, const std::string& only) {
  const double noise = noise_degrees * 3.14159265358979 / 180.0;
  fmt::print("spacing {}, noise of normals {} degrees: air / solid / holes, %\n", spacing,
             noise_degrees);
  fmt::print("{:26}", "");
  for (const auto& rule : kClipRules) fmt::print("| {:20} ", rule.name);
  fmt::print("\n");
  for (const SharpModel& model : sharp_models()) {
    if (model.name.find(only) == std::string::npos) continue;
    const Setup setup = set_up(model, spacing, noise);
    std::vector<Clipped> rules;
    for (const auto& rule : kClipRules)
      rules.emplace_back(
          setup.discs,
          ClipSettings{rule.value, {}, refit ? ClipNormals::Refit : ClipNormals::Given});
    std::vector<bool> at_edge(setup.discs.centres.size());
    std::size_t edges = 0;
    std::array<std::size_t, 5> kinds{};
    for (std::size_t s = 0; s < at_edge.size(); ++s) {
      const ClipKind kind = rules[1].partners().kinds[s];
      at_edge[s] = kind != ClipKind::None;
      edges += at_edge[s] ? 1 : 0;
      ++kinds[static_cast<std::size_t>(kind)];
    }
    const auto errors = measure(model, setup, rules, at_edge);
    fmt::print("{:26}", model.name);
    for (const Errors& error : errors)
      fmt::print("| {:5.2f} {:5.2f} {:6.3f}   ", error.over_air, error.over_solid, error.holes);
    const ClipCounts& counts = rules[1].partners().counts;
    fmt::print(
        " n {} flat {} union {} inter {} mixed {} lines {} partners {} disagree {} thr {:.2f}\n",
        at_edge.size(), kinds[1], kinds[2], kinds[3], kinds[4], rules[1].partners().lines.size(),
        counts.partners, counts.disagreements, counts.threshold);
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace relief::experiment

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fputs("usage: clip_experiment SPACING NOISE_DEGREES given|refit [MODEL]\n", stderr);
    return 2;
  }
  return relief::experiment::run(std::stod(argv[1]), std::stod(argv[2]),
                                 std::string(argv[3]) == "refit", argc > 4 ? argv[4] : "");
}
