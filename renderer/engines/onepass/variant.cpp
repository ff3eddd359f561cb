#include "renderer/engines/onepass/variant.h"

#include <utility>

#include "renderer/engines/onepass/proxies.h"

namespace relief::onepass {
namespace {

DrawBatch make_splat_batch(const Variant& variant, const View& view) {
  const PatchStore& store = variant.samples.store();
  const std::vector<std::uint32_t> visible = find_visible(store, view);
  variant.samples.look(view, visible);
  DrawBatch batch;
  if (!variant.programs.large_sprites) {
    batch.splats =
        variant.samples.make_draw(SampleShape::Quads, by_cull_mode(store, view, visible));
    return batch;
  }
  batch.splats = variant.samples.make_draw(SampleShape::Points, by_cull_mode(store, view, visible));
  const std::vector<std::uint32_t> near =
      find_near(store, view, visible, widest_disc(store), largest_sprite(*variant.gl));
  if (!near.empty())
    batch.large = variant.samples.make_draw(SampleShape::Quads, by_cull_mode(store, view, near));
  return batch;
}

}  // namespace

Result<Variant> Variant::create(const Gl& gl, const PatchStore& store, Features features) {
  RELIEF_TRY_ASSIGN(Programs programs, make_programs(gl, store, features));
  const bool cells = programs.rims.has_value();
  return Variant{&gl, SampleDraws(gl, store, cells), std::move(programs)};
}

DrawBatch make_batch(const Variant& variant, const View& view, const MaterialChoice& materials) {
  return variant.programs.rims ? make_cell_batch(variant, view, materials)
                               : make_splat_batch(variant, view);
}

DrawBatch make_cell_batch(const Variant& variant, const View& view, const MaterialChoice& materials,
                          SeenFrom seen) {
  const PatchStore& store = variant.samples.store();
  const std::vector<std::uint32_t> parts = find_parts(store, view, materials);
  const std::vector<std::uint32_t> proxies = find_proxies(store, view);
  std::vector<std::uint32_t> looked_at;
  looked_at.reserve(parts.size() + proxies.size());
  for (const std::uint32_t part : parts) looked_at.push_back(store.cells->parts[part].patch);
  DrawBatch batch;
  SidedList sided = parts_by_cull_mode(store, view, parts);
  if (seen == SeenFrom::Anywhere) leave_out_backs(store, view, sided.front);
  batch.cells = make_cell_draws(*variant.gl, *store.cells, sided);
  if (store.seams) {
    const std::vector<std::uint32_t> seams = find_seams(store, view, materials);
    add_seams(*variant.gl, store, view, seams_by_cull_mode(store, view, seams), seen, *batch.cells);
    // Also the owners of their vertices, which may be out of view.
    for (const StoredSeam& seam : store.seams->seams) looked_at.push_back(seam.patch);
  }
  for (const std::uint32_t instance : proxies)
    looked_at.push_back(store.instances[instance].proxy->patch);
  batch.proxies = proxy_commands(store, view, proxies);
  variant.samples.look(view, looked_at);
  return batch;
}

}  // namespace relief::onepass
