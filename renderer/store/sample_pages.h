// Sample records on the GPU.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/error.h"
#include "renderer/geometry/samples.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"

namespace relief {

/// Where a patch's records are.
struct RecordRun {
  std::uint32_t page = 0;
  std::uint32_t first = 0;  ///< in that page
  std::uint32_t count = 0;
};

/// Collects the records of patches in the order of the model and uploads them, cut into pages that
/// shaders can see whole.
class SamplePages {
 public:
  explicit SamplePages(const Gl& gl);

  /// Fails if the patch has more than a page.
  Result<RecordRun> add(const std::vector<SampleRecord>& records);

  /// Uploads what is left.
  std::vector<Table> take();

 private:
  void flush();

  const Gl& gl_;
  std::size_t most_records_ = 0;
  std::vector<SampleRecord> current_;
  std::vector<Table> pages_;
};

}  // namespace relief
