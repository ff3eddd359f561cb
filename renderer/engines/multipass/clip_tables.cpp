#include "renderer/engines/multipass/clip_tables.h"

#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <span>
#include <utility>

#include "renderer/clip/clip_partners.h"
#include "renderer/clip/sample_discs.h"
#include "renderer/frame/clip_texels.h"
#include "shaders/include/shared.h"

namespace relief::multipass {
namespace {

/// The tables before they are on the GPU.
struct Collected {
  std::vector<std::vector<glm::uvec2>> ranges;
  std::vector<glm::vec4> texels;  ///< of lines
  std::vector<bool> clipped;
};

/// A line in the base plane of its patch: in a splat's plane heights follow from the place there.
glm::vec4 line_on_grid(const ClipLine& line, const Patch& patch, glm::vec2 slope) {
  const glm::dvec3 direction = glm::transpose(patch.axes) * glm::dvec3(line.direction);
  const glm::dvec2 across = glm::dvec2(direction) + direction.z * glm::dvec2(slope);
  return {glm::vec2(across), static_cast<float>(line.offset / patch.spacing),
          line.ends_group ? 1.0F : 0.0F};
}

/// The plane of a line's partner in the grid frame.
void add_plane(const PartnerPlane& plane, const Patch& patch, std::vector<glm::vec4>& texels) {
  const glm::dmat3 to_grid = glm::transpose(patch.axes);
  texels.emplace_back(glm::vec3(to_grid * glm::dvec3(plane.centre) / patch.spacing),
                      plane.edge_is_concave ? 1.0F : 0.0F);
  texels.emplace_back(glm::vec3(to_grid * glm::dvec3(plane.normal)), 0.0F);
}

/// Adds the splats of patch `k` of a run; returns whether some of them are clipped.
bool add_patch(const Patch& patch, const SampleDiscs& samples, std::size_t k,
               const ClipPartners& partners, const RecordRun& records, Collected& out) {
  bool some = false;
  std::vector<glm::uvec2>& ranges = out.ranges[records.page];
  for (std::uint32_t r = 0; r < records.count; ++r) {
    const std::size_t splat = samples.first[k] + r;
    const std::span<const ClipLine> lines = partners.of(splat);
    ranges[records.first + r] = clip_range(out.texels.size(), lines.size(), partners.kinds[splat]);
    for (std::size_t l = 0; l < lines.size(); ++l) {
      out.texels.push_back(line_on_grid(lines[l], patch, samples.slopes[splat]));
      if (!partners.planes.empty()) add_plane(partners.planes_of(splat)[l], patch, out.texels);
    }
    some = some || !lines.empty();
  }
  return some;
}

/// The run of patches that an instance is of, and where its levels are in the store.
struct PlacedRun {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  std::uint32_t first_level = 0;  ///< in PatchStore::levels
};

std::vector<PlacedRun> runs_of(const PatchModel& model, const PatchStore& store) {
  std::vector<PlacedRun> runs;
  for (std::size_t i = 0; i < store.instances.size(); ++i) {
    const StoredInstance& stored = store.instances[i];
    if (stored.count == 0) continue;
    const std::uint32_t first = model.instances.empty() ? 0 : model.instances[i].first;
    runs.push_back({first, stored.count, stored.first});
  }
  return runs;
}

/// Notes which of a placed run's patches have clipped splats.
void place(const PlacedRun& run, const std::vector<bool>& some, const PatchStore& store,
           Collected& out) {
  for (std::uint32_t k = 0; k < run.count; ++k)
    out.clipped[store.levels[run.first_level + k].first] = some[k];
}

Result<std::vector<bool>> add_run(const PlacedRun& run, const PatchModel& model,
                                  const PatchStore& store, const ClipSettings& settings,
                                  double radius_factor, Progress& progress, Collected& out) {
  RELIEF_TRY_ASSIGN(const SampleDiscs samples,
                    make_sample_discs(model, run.first, run.count, radius_factor, progress));
  RELIEF_TRY_ASSIGN(const ClipPartners partners,
                    find_clip_partners(samples.discs, settings, progress));
  std::vector<bool> some;
  for (std::uint32_t k = 0; k < run.count; ++k) {
    const RecordRun& records = store.patches[store.levels[run.first_level + k].first].records;
    some.push_back(add_patch(model.patches[run.first + k], samples, k, partners, records, out));
  }
  return some;
}

}  // namespace

Result<ClipTables> make_clip_tables(const Gl& gl, const PatchModel& model, const PatchStore& store,
                                    const ClipSettings& settings, double radius_factor,
                                    Progress& progress) {
  Collected collected;
  collected.clipped.resize(store.patches.size(), false);
  collected.ranges.resize(store.pages.size());
  for (const StoredPatch& patch : store.patches) {
    if (patch.records.count == 0) continue;
    std::vector<glm::uvec2>& ranges = collected.ranges[patch.records.page];
    ranges.resize(std::max<std::size_t>(ranges.size(), patch.records.first + patch.records.count),
                  glm::uvec2(0));
  }
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<bool>> done;
  for (const PlacedRun& run : runs_of(model, store)) {
    auto found = done.find({run.first, run.count});
    if (found == done.end()) {
      RELIEF_TRY_ASSIGN(auto some,
                        add_run(run, model, store, settings, radius_factor, progress, collected));
      found = done.emplace(std::pair(run.first, run.count), std::move(some)).first;
    }
    place(run, found->second, store, collected);
  }
  RELIEF_TRY_ASSIGN(Table lines, make_clip_lines(gl, collected.texels));
  ClipTables tables{{}, std::move(lines), std::move(collected.clipped)};
  for (const std::vector<glm::uvec2>& ranges : collected.ranges) {
    tables.ranges.push_back(
        make_table(gl, "clip ranges", GL_RG32UI, std::span<const glm::uvec2>(ranges)));
  }
  RELIEF_TRY(check_errors(gl, "the clip lines"));
  return tables;
}

Result<const ClipTables*> ClipTableCache::get(const Gl& gl, const PatchStore& store,
                                              const ClipSettings& settings, double radius_factor,
                                              Progress& progress) {
  if (settings.rule == ClipRule::Off) return nullptr;
  if (model_ == nullptr) {
    return make_error(
        "splats of a file with tiles can't be clipped, because its patches come and go; render "
        "without --clip-partners, or a file without tiles");
  }
  if (!made_ || made_->settings != settings || made_->radius_factor != radius_factor) {
    RELIEF_TRY_ASSIGN(ClipTables tables,
                      make_clip_tables(gl, *model_, store, settings, radius_factor, progress));
    made_ = Made{settings, radius_factor, std::move(tables)};
  }
  return &made_->tables;
}

}  // namespace relief::multipass
