#include "renderer/store/sample_pages.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

namespace relief {

std::size_t most_sample_records(const Gl& gl) {
  // Quads count four vertices a record in signed 32-bit numbers.
  return static_cast<std::size_t>(std::min(get_limit(gl, GL_MAX_TEXTURE_BUFFER_SIZE),
                                           std::numeric_limits<std::int32_t>::max() / 4));
}

Result<RecordRun> SamplePages::add(const std::vector<SampleRecord>& records) {
  if (records.size() > most_records_) {
    return make_error(
        "a patch has {} samples, more than this OpenGL can draw ({}); convert again "
        "with a larger spacing",
        records.size(), most_records_);
  }
  if (current_.size() + records.size() > most_records_)
    pages_.push_back(std::exchange(current_, {}));
  const RecordRun run{static_cast<std::uint32_t>(pages_.size()),
                      static_cast<std::uint32_t>(current_.size()),
                      static_cast<std::uint32_t>(records.size())};
  current_.insert(current_.end(), records.begin(), records.end());
  return run;
}

std::vector<std::vector<SampleRecord>> SamplePages::take() {
  if (!current_.empty()) pages_.push_back(std::exchange(current_, {}));
  return std::move(pages_);
}

Table upload_page(const Gl& gl, const std::vector<SampleRecord>& records) {
  return make_table(gl, "sample records", GL_RGBA32UI, std::span<const SampleRecord>(records));
}

}  // namespace relief
