#include "renderer/store/cell_store.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "renderer/store/patch_attributes.h"
#include "shaders/include/shared.h"

namespace relief {

CellUpload::CellUpload(const Gl& gl) : gl_(gl) {
  // There are no more runs and no more rims than heights. Vertices, kRunVertices a run, are counted
  // in signed 32-bit numbers.
  most_texels_ = static_cast<std::size_t>(
      std::min(get_limit(gl, GL_MAX_TEXTURE_BUFFER_SIZE),
               std::numeric_limits<std::int32_t>::max() / shared::kRunVertices));
}

Result<UploadedCells> CellUpload::add(const PatchCells& cells) {
  if (cells.heights.size() + cells.rows.size() + 1 > most_texels_) {
    return make_error(
        "a patch has {} samples, more than this OpenGL can draw ({}); convert again "
        "with a larger spacing",
        cells.heights.size(), most_texels_);
  }
  if (heights_.size() + rows_.size() + cells.heights.size() + cells.rows.size() > most_texels_)
    flush();
  if (rows_.empty()) rows_.push_back({});
  UploadedCells uploaded{static_cast<std::int32_t>(rows_.size()), {}};
  uploaded.parts.reserve(cells.parts.size());
  const auto first_height = static_cast<std::uint32_t>(heights_.size());
  heights_.insert(heights_.end(), cells.heights.begin(), cells.heights.end());
  for (const CellRow& row : cells.rows) rows_.push_back({row.base + first_height, row.span});
  for (const CellPart& part : cells.parts) {
    PartBuffers buffers;
    buffers.page = static_cast<std::uint32_t>(pages_.size());
    buffers.first_run = static_cast<std::uint32_t>(runs_.size());
    buffers.runs = static_cast<std::uint32_t>(part.runs.size());
    buffers.edge_runs = static_cast<std::uint32_t>(part.edge_runs.size());
    buffers.first_rim = static_cast<std::uint32_t>(rims_.size());
    buffers.rims = static_cast<std::uint32_t>(part.rims.size());
    buffers.first_strip = static_cast<std::uint32_t>(strips_.size());
    buffers.strip = static_cast<std::uint32_t>(part.strip.size());
    uploaded.parts.push_back({part.corner, part.centre, part.radius, part.normals, buffers});
    runs_.insert(runs_.end(), part.runs.begin(), part.runs.end());
    runs_.insert(runs_.end(), part.edge_runs.begin(), part.edge_runs.end());
    rims_.insert(rims_.end(), part.rims.begin(), part.rims.end());
    strips_.insert(strips_.end(), part.strip.begin(), part.strip.end());
  }
  return uploaded;
}

std::vector<CellPage> CellUpload::take(const Buffer& positions) {
  if (!rows_.empty()) flush();
  for (CellPage& page : pages_) {
    if (!page.strips) continue;
    page.attributes =
        make_patch_attributes(gl_, "cell strips", positions, sizeof(glm::uvec2), *page.strips);
    add_instance_attribute(gl_, *page.attributes, RELIEF_ATTRIBUTE_CORNER,
                           sizeof(glm::uvec2::value_type));
  }
  return std::move(pages_);
}

void CellUpload::flush() {
  pages_.push_back(
      {make_table(gl_, "cell heights", GL_R16UI, std::span<const std::uint16_t>(heights_)),
       make_table(gl_, "cell rows", GL_RG32UI, std::span<const CellRow>(rows_)),
       make_table(gl_, "cell runs", GL_R32UI, std::span<const std::uint32_t>(runs_)),
       make_table(gl_, "rims", GL_RG32UI, std::span<const RimRecord>(rims_)), std::nullopt,
       std::nullopt});
  if (!strips_.empty()) {
    pages_.back().strips = make_buffer(gl_, "cell strips", std::span<const std::uint16_t>(strips_));
  }
  heights_.clear();
  rows_.clear();
  runs_.clear();
  rims_.clear();
  strips_.clear();
}

}  // namespace relief
