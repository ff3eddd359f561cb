// The cells of a model on the GPU.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "common/error.h"
#include "renderer/geometry/cells.h"
#include "renderer/geometry/samples.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"

namespace relief {

/// Where a part's runs and rims are on the GPU.
struct PartBuffers {
  std::uint32_t page = 0;
  std::uint32_t first_run = 0;  ///< in that page
  std::uint32_t runs = 0;
  std::uint32_t edge_runs = 0;  ///< follow them
  std::uint32_t first_rim = 0;
  std::uint32_t rims = 0;
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

/// The buffers of some patches; more than one page only for a model that is larger than what OpenGL
/// lets a shader see of one buffer.
struct CellPage {
  Table heights;  ///< 16 bits a node, as PatchCells has them
  Table rows;     ///< CellRow; the first has no nodes, as has the one after each patch
  Table runs;     ///< CellPart::runs
  Table rims;     ///< RimRecord
  std::optional<Buffer> strips;           ///< CellPart::strip, 16 bits a node
  std::optional<VertexArray> attributes;  ///< of strips: their nodes, and CellStore::positions
};

struct CellStore {
  std::vector<StoredPart> parts;
  std::vector<CellPage> pages;
  Buffer positions;  ///< per part the two per-instance attributes, patch and corner
};

/// Collects the cells of patches in the order of the model and uploads them page by page.
class CellUpload {
 public:
  explicit CellUpload(const Gl& gl);

  /// Fails if the patch is larger than a page.
  Result<UploadedCells> add(const PatchCells& cells);

  /// Uploads what is left. `positions`: CellStore::positions.
  std::vector<CellPage> take(const Buffer& positions);

 private:
  void flush();

  const Gl& gl_;
  std::size_t most_texels_ = 0;
  std::vector<std::uint16_t> heights_;
  std::vector<CellRow> rows_;
  std::vector<std::uint32_t> runs_;
  std::vector<RimRecord> rims_;
  std::vector<std::uint16_t> strips_;
  std::vector<CellPage> pages_;
};

}  // namespace relief
