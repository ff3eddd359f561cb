// The cells of a model on the GPU.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "common/error.h"
#include "renderer/geometry/cells/cells.h"
#include "renderer/geometry/samples/samples.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"

namespace relief {

/// Where what a part draws is on the GPU.
struct PartBuffers {
  std::uint32_t page = 0;
  std::uint32_t first_run = 0;  ///< in that page
  std::uint32_t runs = 0;
  std::uint32_t edge_runs = 0;  ///< follow them
  std::uint32_t first_rim = 0;
  std::uint32_t rims = 0;
  std::uint32_t first_border = 0;
  std::uint32_t borders = 0;
  std::uint32_t first_strip = 0;  ///< node of its strip
  std::uint32_t strip = 0;        ///< nodes of it
};

/// What the CPU keeps of a part of a patch. World frame, in double precision.
struct StoredPart {
  std::uint32_t patch = 0;
  glm::dvec3 centre{0.0};  ///< of a sphere about all that it draws
  double radius = 0.0;
  NormalBounds normals;  ///< as CellPart has them
  PartBuffers buffers;
};

/// The cells of a patch on the GPU, wherever it stands.
struct UploadedCells {
  struct Part {
    glm::uvec2 corner{0};    ///< its first node
    glm::dvec3 centre{0.0};  ///< as StoredPart has it, but in the grid frame (cells)
    double radius = 0.0;
    NormalBounds normals;
    PartBuffers buffers;
  };
  std::int32_t first_row = 0;  ///< of its rows, in its page
  std::vector<Part> parts;
};

/// The cells of some patches as they are uploaded.
struct CellPageData {
  std::vector<std::uint16_t> heights;  ///< 16 bits a node, as PatchCells has them
  std::vector<CellRow> rows;           ///< the first has no nodes, as has the one after each patch
  std::vector<std::uint32_t> runs;     ///< CellPart::runs
  std::vector<BorderCell> borders;
  std::vector<RimRecord> rims;
  std::vector<std::uint16_t> strips;  ///< CellPart::strip

  [[nodiscard]] std::size_t bytes() const {
    return (heights.size() + strips.size()) * sizeof(std::uint16_t) +
           rows.size() * sizeof(CellRow) + runs.size() * sizeof(std::uint32_t) +
           borders.size() * sizeof(BorderCell) + rims.size() * sizeof(RimRecord);
  }
};

/// The buffers of some patches; more than one page for a model that is larger than what OpenGL lets
/// a shader see of one buffer, and for one whose patches come and go.
struct CellPage {
  Table heights;
  Table rows;
  Table runs;
  Table borders;
  Table rims;
  std::optional<Buffer> strips;
  std::optional<VertexArray> attributes;  ///< of strips: their nodes, and CellStore::positions
};

struct CellStore {
  std::vector<StoredPart> parts;
  std::vector<CellPage> pages;
  Buffer positions;  ///< per part the two per-instance attributes, patch and corner
};

/// Collects the cells of patches in the order of the model, page by page.
class CellPages {
 public:
  /// `most_texels`: most_cell_texels().
  explicit CellPages(std::size_t most_texels) : most_texels_(most_texels) {}

  /// Fails if the patch is larger than a page.
  Result<UploadedCells> add(const PatchCells& cells);

  /// Ends the last page, and returns all.
  std::vector<CellPageData> take();

 private:
  std::size_t most_texels_;
  std::vector<CellPageData> pages_;
  CellPageData current_;
};

/// Returns the most heights and rows of a page.
[[nodiscard]] std::size_t most_cell_texels(const Gl& gl);

/// Uploads a page. `positions`: CellStore::positions.
CellPage upload_page(const Gl& gl, const CellPageData& data, const Buffer& positions);

/// Makes CellPage::attributes for other positions.
void attach_positions(const Gl& gl, const Buffer& positions, CellPage& page);

}  // namespace relief
