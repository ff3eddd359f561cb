#include "renderer/store/sample_pages.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

namespace relief {

SamplePages::SamplePages(const Gl& gl) : gl_(gl) {
  // Quads count four vertices a record in signed 32-bit numbers.
  most_records_ = static_cast<std::size_t>(std::min(get_limit(gl, GL_MAX_TEXTURE_BUFFER_SIZE),
                                                    std::numeric_limits<std::int32_t>::max() / 4));
}

Result<RecordRun> SamplePages::add(const std::vector<SampleRecord>& records) {
  if (records.size() > most_records_) {
    return make_error(
        "a patch has {} samples, more than this OpenGL can draw ({}); convert again "
        "with a larger spacing",
        records.size(), most_records_);
  }
  if (current_.size() + records.size() > most_records_) flush();
  const RecordRun run{static_cast<std::uint32_t>(pages_.size()),
                      static_cast<std::uint32_t>(current_.size()),
                      static_cast<std::uint32_t>(records.size())};
  current_.insert(current_.end(), records.begin(), records.end());
  return run;
}

std::vector<Table> SamplePages::take() {
  if (!current_.empty()) flush();
  return std::move(pages_);
}

void SamplePages::flush() {
  pages_.push_back(
      make_table(gl_, "sample records", GL_RGBA32UI, std::span<const SampleRecord>(current_)));
  current_.clear();
}

}  // namespace relief
