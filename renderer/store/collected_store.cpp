#include "renderer/store/collected_store.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "renderer/view/cull_mode.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

/// A model without instances is one instance that leaves it where it is.
std::vector<Instance> instances_of(const PatchModel& model) {
  if (!model.instances.empty()) return model.instances;
  const std::uint8_t material = model.patches.empty() ? 0 : model.patches.front().material;
  return {{0, static_cast<std::uint32_t>(model.patches.size()), {}, material, model.is_closed}};
}

CellStore upload_cells(const Gl& gl, GridUpload& grids, CollectedModel& model) {
  Buffer positions =
      make_buffer(gl, "part positions", std::span<const glm::uvec2>(model.positions));
  std::vector<CellPage> pages;
  for (const CellPageData& page : grids.take_cells())
    pages.push_back(upload_page(gl, page, positions));
  return {std::move(model.parts), std::move(pages), std::move(positions)};
}

bool has_proxies(const StoreOrder& order) {
  return std::ranges::any_of(order.views,
                             [](const View& view) { return view.proxy_diameter > 0.0; });
}

}  // namespace

bool CollectedStore::serves(const StoreOrder& order) const {
  return order_.all_levels && order.all_levels && order_.needs == order.needs &&
         has_proxies(order_) == has_proxies(order) &&
         make_use_of_bodies(order_.views) == make_use_of_bodies(order.views);
}

Result<std::unique_ptr<CollectedStore>> CollectedStore::collect(const StoreLimits& limits,
                                                                const PatchModel& model,
                                                                StoreOrder order,
                                                                const std::stop_token& stop) {
  std::unique_ptr<CollectedStore> made(new CollectedStore(limits, model, std::move(order)));
  for (const Instance& instance : instances_of(model))
    RELIEF_TRY(made->collector_.add(instance, stop));
  RELIEF_TRY(made->collector_.add_seam_blocks());
  return made;
}

Result<PatchStore> CollectedStore::upload(const Gl& gl) {
  ModelCollector& collector = collector_;
  const StoreNeeds& needs = order_.needs;
  RELIEF_TRY_ASSIGN(GridMaps maps, collector.grids().make_maps(gl));
  const std::vector<shared::PatchInfo> table = collector.table();
  CollectedModel& collected = collector.collected();
  PatchStore store{
      .instances = std::move(collected.instances),
      .patches = std::move(collected.patches),
      .levels = std::move(collected.levels),
      .pages = {},
      .table = make_table(gl, "patch table", GL_RGBA32I, std::span<const shared::PatchInfo>(table)),
      .heights = std::move(maps.heights),
      .normals = std::move(maps.normals),
      .colours = std::move(maps.colours),
      .masks = std::move(maps.masks)};
  for (const std::vector<SampleRecord>& page : collector.grids().take_records())
    store.pages.push_back(upload_page(gl, page));
  if (needs.cells) store.cells = upload_cells(gl, collector.grids(), collected);
  if (!collector.seams().empty())
    store.seams = collector.seams().take(gl, std::move(collected.seams), store.cells->positions);
  if (!collector.proxies().empty()) store.proxies = collector.proxies().take(gl, needs.sources);
  if (needs.bodies)
    store.bodies = make_table(gl, "bodies", GL_R32F, std::span<const float>(collected.diameters));
  if (needs.splats || !needs.cells) {
    std::vector<std::uint32_t> indices(store.patches.size());
    std::iota(indices.begin(), indices.end(), 0U);
    store.indices = make_buffer(gl, "patch indices", std::span<const std::uint32_t>(indices));
  }
  RELIEF_TRY(check_errors(gl, "the model"));
  return store;
}

}  // namespace relief
