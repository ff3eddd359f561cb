#include "renderer/store/cell_store.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "renderer/store/patch_attributes.h"
#include "shaders/include/shared.h"

namespace relief {

std::size_t most_cell_texels(const Gl& gl) {
  // There are no more runs and no more rims than heights. Vertices, kRunVertices a run and fewer a
  // border cell, are counted in signed 32-bit numbers.
  static_assert(shared::kBorderVertices < shared::kRunVertices);
  return static_cast<std::size_t>(
      std::min(get_limit(gl, GL_MAX_TEXTURE_BUFFER_SIZE),
               std::numeric_limits<std::int32_t>::max() / shared::kRunVertices));
}

Result<UploadedCells> CellPages::add(const PatchCells& cells) {
  std::size_t borders = 0;
  for (const CellPart& part : cells.parts) borders += part.borders.size();
  if (std::max(cells.heights.size() + cells.rows.size() + 1, borders) > most_texels_) {
    return make_error(
        "a patch has {} samples, more than this OpenGL can draw ({}); convert again "
        "with a larger spacing",
        cells.heights.size(), most_texels_);
  }
  CellPageData& page = current_;
  if (page.heights.size() + page.rows.size() + cells.heights.size() + cells.rows.size() >
          most_texels_ ||
      page.borders.size() + borders > most_texels_)
    pages_.push_back(std::exchange(page, {}));
  if (page.rows.empty()) page.rows.push_back({});
  UploadedCells uploaded{static_cast<std::int32_t>(page.rows.size()), {}};
  uploaded.parts.reserve(cells.parts.size());
  const auto first_height = static_cast<std::uint32_t>(page.heights.size());
  page.heights.insert(page.heights.end(), cells.heights.begin(), cells.heights.end());
  for (const CellRow& row : cells.rows) page.rows.push_back({row.base + first_height, row.span});
  for (const CellPart& part : cells.parts) {
    PartBuffers buffers;
    buffers.page = static_cast<std::uint32_t>(pages_.size());
    buffers.first_run = static_cast<std::uint32_t>(page.runs.size());
    buffers.runs = static_cast<std::uint32_t>(part.runs.size());
    buffers.edge_runs = static_cast<std::uint32_t>(part.edge_runs.size());
    buffers.first_rim = static_cast<std::uint32_t>(page.rims.size());
    buffers.rims = static_cast<std::uint32_t>(part.rims.size());
    buffers.first_border = static_cast<std::uint32_t>(page.borders.size());
    buffers.borders = static_cast<std::uint32_t>(part.borders.size());
    buffers.first_strip = static_cast<std::uint32_t>(page.strips.size());
    buffers.strip = static_cast<std::uint32_t>(part.strip.size());
    uploaded.parts.push_back({part.corner, part.centre, part.radius, part.normals, buffers});
    page.runs.insert(page.runs.end(), part.runs.begin(), part.runs.end());
    page.runs.insert(page.runs.end(), part.edge_runs.begin(), part.edge_runs.end());
    page.borders.insert(page.borders.end(), part.borders.begin(), part.borders.end());
    page.rims.insert(page.rims.end(), part.rims.begin(), part.rims.end());
    page.strips.insert(page.strips.end(), part.strip.begin(), part.strip.end());
  }
  return uploaded;
}

std::vector<CellPageData> CellPages::take() {
  if (!current_.rows.empty()) pages_.push_back(std::exchange(current_, {}));
  return std::move(pages_);
}

CellPage upload_page(const Gl& gl, const CellPageData& data, const Buffer& positions) {
  CellPage page{
      make_table(gl, "cell heights", GL_R16UI, std::span<const std::uint16_t>(data.heights)),
      make_table(gl, "cell rows", GL_RG32UI, std::span<const CellRow>(data.rows)),
      make_table(gl, "cell runs", GL_R32UI, std::span<const std::uint32_t>(data.runs)),
      make_table(gl, "border cells", GL_RG32UI, std::span<const BorderCell>(data.borders)),
      make_table(gl, "rims", GL_RG32UI, std::span<const RimRecord>(data.rims)),
      std::nullopt,
      std::nullopt};
  if (!data.strips.empty())
    page.strips = make_buffer(gl, "cell strips", std::span<const std::uint16_t>(data.strips));
  attach_positions(gl, positions, page);
  return page;
}

void attach_positions(const Gl& gl, const Buffer& positions, CellPage& page) {
  if (!page.strips) return;
  page.attributes =
      make_patch_attributes(gl, "cell strips", positions, sizeof(glm::uvec2), *page.strips);
  add_instance_attribute(gl, *page.attributes, RELIEF_ATTRIBUTE_CORNER,
                         sizeof(glm::uvec2::value_type));
}

}  // namespace relief
