#include "common/export/export_file.h"

#include <algorithm>
#include <utility>

#include "common/bounds.h"
#include "common/export/export.h"

namespace relief {

Result<ExportFile> ExportFile::create(const std::filesystem::path& path, std::uint64_t records,
                                      Progress& progress) {
  RELIEF_TRY_ASSIGN(auto file, AtomicFile::create(path));
  progress.begin_stage("write", records);
  return ExportFile(std::move(file), progress);
}

bool ExportFile::flush() {
  if (status_ && progress_->cancelled()) status_ = interrupted_error();
  if (status_) status_ = file_.write(buffer_);
  buffer_.clear();
  progress_->advance(records_);
  records_ = 0;
  return static_cast<bool>(status_);
}

Status ExportFile::finish() {
  if (!flush()) return status_;
  return file_.commit();
}

bool needs_doubles(const Points& points, double tolerance) {
  const Bounds box = bounds_of(points.positions);
  if (box.empty()) return false;
  double largest = 0.0;
  for (int i = 0; i < 3; ++i)
    largest = std::max({largest, std::abs(box.min[i]), std::abs(box.max[i])});
  constexpr double rounding = 1.0 / (1U << 24U);  // half a float's last bit
  return largest * rounding > tolerance;
}

}  // namespace relief
