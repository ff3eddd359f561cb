// Sample records on the GPU.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/error.h"
#include "renderer/geometry/samples/samples.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"

namespace relief {

/// Where a patch's records are.
struct RecordRun {
  std::uint32_t page = 0;
  std::uint32_t first = 0;  ///< in that page
  std::uint32_t count = 0;
};

/// Collects the records of patches in the order of the model, cut into pages that shaders can see
/// whole.
class SamplePages {
 public:
  /// `most_records`: most_sample_records().
  explicit SamplePages(std::size_t most_records) : most_records_(most_records) {}

  /// Fails if the patch has more than a page.
  Result<RecordRun> add(const std::vector<SampleRecord>& records);

  /// Ends the last page, and returns all.
  std::vector<std::vector<SampleRecord>> take();

 private:
  std::size_t most_records_;
  std::vector<SampleRecord> current_;
  std::vector<std::vector<SampleRecord>> pages_;
};

/// Returns the most records of a page.
[[nodiscard]] std::size_t most_sample_records(const Gl& gl);

[[nodiscard]] Table upload_page(const Gl& gl, const std::vector<SampleRecord>& records);

}  // namespace relief
