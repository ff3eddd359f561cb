#include "preprocess/tiles/scan_blocks.h"

#include <fmt/format.h>

#include <utility>

#include "common/guard.h"
#include "common/io/file.h"
#include "common/io/mapped_file.h"
#include "common/is_finite.h"
#include "preprocess/points/keep_points.h"
#include "preprocess/readers/format.h"
#include "preprocess/readers/gzip/gunzip.h"
#include "preprocess/readers/read_points.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

// For formats that are read as a whole: while reading, points take up to this many times the file's
// bytes (a binary PCD of x, y, z as floats: 12 bytes become 24, beside the file).
constexpr std::uint64_t kMemoryPerFileByte = 4;

void drop_nonfinite(Points& points, ScanCounts& counts) {
  std::vector<std::uint8_t> dropped(points.size());
  for (std::size_t i = 0; i < dropped.size(); ++i)
    dropped[i] = is_finite(points.positions[i]) ? 0 : 1;
  counts.nonfinite += drop_points(points, dropped);
  counts.points += points.size();
}

/// Passes a reader's blocks on and releases the memory of bytes already read.
class FileSink final : public PointSink {
 public:
  FileSink(const MappedFile& file, const ReadOptions& options, const ReadRemarks& remarks,
           std::string name, const TakePoints& take, ScanCounts& counts)
      : file_(file),
        options_(options),
        remarks_(remarks),
        name_(std::move(name)),
        take_(take),
        counts_(counts) {}

  Status take(Points block) override {
    block.texcoords.clear();
    RELIEF_TRY(check_scalars(name_, options_.scalars, remarks_));
    drop_infinite(block.scalars);
    drop_nonfinite(block, counts_);
    if (const auto& crop = options_.selection.crop) {
      for (const glm::dvec3& p : block.positions) extend(bounds_, p);
      const std::uint64_t outside = crop_points(block, *crop);
      counts_.points -= outside;
      counts_.not_selected += outside;
    }
    taken_ += block.size();
    return take_(std::move(block));
  }

  /// Fails if the crop has left none of the points. Call it after the last one.
  [[nodiscard]] Status check_crop() const {
    const auto& crop = options_.selection.crop;
    if (crop && taken_ == 0 && !bounds_.empty()) return nothing_in_crop(name_, *crop, bounds_);
    return {};
  }

  void pass(std::size_t offset) override { file_.release_before(offset); }

 private:
  const MappedFile& file_;
  const ReadOptions& options_;
  const ReadRemarks& remarks_;  ///< of the reader, which fills it
  std::string name_;
  const TakePoints& take_;
  ScanCounts& counts_;
  Bounds bounds_;  ///< of all finite points, if they are cropped
  std::uint64_t taken_ = 0;
};

/// Opens a file, unpacked if it is packed. Reuses an earlier unpacked copy.
Result<MappedFile> open_unpacked(const fs::path& path, const fs::path& unpacked,
                                 const Progress& progress) {
  auto file = MappedFile::open(path);
  if (!file || !is_gzip(file->bytes())) return file;
  if (!fs::exists(unpacked)) {
    RELIEF_TRY_ASSIGN(auto out, AtomicFile::create(unpacked));
    const Status done = gunzip_pieces(path.string(), file->bytes(), progress,
                                      [&](std::span<const std::byte> piece, std::size_t used) {
                                        file->release_before(used);
                                        return out.write(piece);
                                      });
    if (!done) return done.error();
    RELIEF_TRY(out.commit());
  }
  return MappedFile::open(unpacked);
}

Status read_file_blocks(const fs::path& path, const MappedFile& file, const ReadOptions& options,
                        std::uint64_t memory, const TakePoints& take, ScanCounts& counts,
                        std::vector<std::string>& notes, Progress& progress) {
  std::string_view text(reinterpret_cast<const char*>(file.bytes().data()), file.bytes().size());
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  RELIEF_TRY_ASSIGN(const PointFormat* const format, find_format(path, text, options.format));
  RELIEF_TRY(check_classes(path.string(), *format, options.selection));
  if (!format->streams && text.size() > memory / kMemoryPerFileByte) {
    return make_error(
        "{}: its {} MB can only be read as a whole, for which --memory is too small; use more "
        "memory, or a format that is read in blocks: {}",
        path.string(), text.size() / 1'000'000, streamed_formats());
  }
  ReadRemarks remarks;
  FileSink sink(file, options, remarks, path.string(), take, counts);
  auto rest =
      format->read({path.string(), text, progress, remarks, format->streams ? &sink : nullptr,
                    &options.selection, &options.scalars});
  if (!rest) return rest.error();
  rest->stance = stance_of(*rest);
  if (!rest->triangles.empty()) {
    remarks.notes.push_back(
        fmt::format("{}: its triangles are not used with --memory", path.string()));
    rest->triangles.clear();
  }
  counts.left_out += remarks.left_out;
  counts.not_selected += remarks.not_selected;
  notes.insert(notes.end(), remarks.notes.begin(), remarks.notes.end());
  RELIEF_TRY(sink.take(std::move(*rest)));
  return sink.check_crop();
}

}  // namespace

Result<ScanCounts> read_blocks(const std::vector<fs::path>& files, const fs::path& folder,
                               const ReadOptions& options, std::uint64_t memory,
                               const TakePoints& take, std::vector<std::string>& notes,
                               Progress& progress) {
  ScanCounts counts;
  for (std::size_t number = 0; number < files.size(); ++number) {
    const fs::path& path = files[number];
    const std::string name = path.string();
    const GuardedCall reading{
        .subject = name,
        .task = "read it",
        .advice = "the file may be damaged: write it again, or convert it to PLY",
        .memory_advice = "set a lower --memory"};
    RELIEF_TRY(guarded(reading, [&]() -> Status {
      RELIEF_TRY_ASSIGN(const auto file,
                        open_unpacked(path, folder / fmt::format("unpacked-{}", number), progress));
      return read_file_blocks(path, file, options, memory, take, counts, notes, progress);
    }));
  }
  if (counts.points == 0) {
    return make_error("{}: holds no points with finite coordinates", files.front().string());
  }
  return counts;
}

}  // namespace relief
