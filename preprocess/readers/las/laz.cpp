// Packed LAS files, through LASzip if the build has it. A source of its own: LASzip's header names
// all of namespace std.
#include "preprocess/readers/las/las_point.h"

#ifdef RELIEF_LASZIP
#include <laszip/laszip_api.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <istream>
#include <streambuf>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/io/confined_child.h"
#endif

namespace relief {

#ifdef RELIEF_LASZIP
namespace {

/// Records that the child writes at a time take about so much.
constexpr std::size_t kBatchBytes = 65536;
/// Memory that LASzip may take beside the file.
constexpr std::uint64_t kMostMemory = std::uint64_t{2} << 30U;

/// What the child writes before each batch of points. A batch without points is the last one, and
/// `text` says why it ends.
struct BatchHeader {
  std::uint32_t points = 0;
  std::uint64_t offset = 0;  ///< bytes of the file that have been read
  std::array<char, 160> text{};
};
static_assert(std::is_trivially_copyable_v<BatchHeader>);

std::size_t points_of_batch(const LasHeader& header) {
  return std::max(kBatchBytes / header.stride, std::size_t{1});
}

/// A file in memory as a stream.
class TextBuffer final : public std::streambuf {
 public:
  explicit TextBuffer(std::string_view text) {
    char* const begin = const_cast<char*>(text.data());  // NOLINT: never written to
    setg(begin, begin, begin + text.size());
  }
  [[nodiscard]] std::size_t position() const { return static_cast<std::size_t>(gptr() - eback()); }

 protected:
  pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode) override {
    off_type to = offset;
    if (from == std::ios_base::cur) to += gptr() - eback();
    if (from == std::ios_base::end) to += egptr() - eback();
    if (to < 0 || to > egptr() - eback()) return pos_type(off_type(-1));
    setg(eback(), eback() + to, egptr());
    return pos_type(to);
  }
  pos_type seekpos(pos_type position, std::ios_base::openmode mode) override {
    return seekoff(off_type(position), std::ios_base::beg, mode);
  }
};

/// Writes a point as the record of a plain file, but for its wave packet. Fields that LASzip counts
/// in bits are packed as the format has them.
void write_record(const laszip_point_struct& p, const LasHeader& header, char* record) {
  std::memset(record, 0, header.stride);
  const auto put = [record](std::size_t at, auto value) {
    std::memcpy(record + at, &value, sizeof value);
  };
  const auto put_bits = [put](std::size_t at, unsigned bits) {
    put(at, static_cast<std::uint8_t>(bits));
  };
  put(0, p.X);
  put(4, p.Y);
  put(8, p.Z);
  put(12, p.intensity);
  put(17, p.user_data);
  const unsigned line = p.scan_direction_flag * 64U + p.edge_of_flight_line * 128U;
  if (header.is_wide()) {
    put_bits(14, p.extended_return_number + p.extended_number_of_returns * 16U);
    put_bits(15, p.extended_classification_flags + p.extended_scanner_channel * 16U + line);
    put(16, p.extended_classification);
    put(18, p.extended_scan_angle);
    put(20, p.point_source_ID);
  } else {
    put_bits(14, p.return_number + p.number_of_returns * 8U + line);
    put_bits(15, p.classification + p.synthetic_flag * 32U + p.keypoint_flag * 64U +
                     p.withheld_flag * 128U);
    put(16, p.scan_angle_rank);
    put(18, p.point_source_ID);
  }
  if (const std::size_t at = header.time_at(); at > 0) put(at, p.gps_time);
  if (const std::size_t at = header.colour_at(); at > 0) std::memcpy(record + at, p.rgb, 6);
  const std::size_t standard = header.standard_bytes();
  const auto extra = static_cast<std::size_t>(std::max(p.num_extra_bytes, 0));
  if (extra > 0 && p.extra_bytes != nullptr)
    std::memcpy(record + standard, p.extra_bytes, std::min(extra, header.stride - standard));
}

/// Unpacks the points into a pipe, in the child.
void unpack(std::string_view text, const LasHeader& header, const ChildOutput& output) {
  TextBuffer buffer(text);
  std::istream stream(&buffer);
  laszip_POINTER laszip = nullptr;
  laszip_point_struct* point = nullptr;
  laszip_BOOL is_packed = 0;
  BatchHeader batch;
  const std::size_t most = points_of_batch(header);
  std::vector<char> records(most * header.stride);
  bool good = laszip_create(&laszip) == 0 &&
              laszip_open_reader_stream(laszip, stream, &is_packed) == 0 &&
              laszip_get_point_pointer(laszip, &point) == 0;
  for (std::uint64_t i = 0; good && i < header.points; ++i) {
    good = laszip_read_point(laszip) == 0;
    if (good) write_record(*point, header, records.data() + batch.points++ * header.stride);
    if (batch.points < most && good && i + 1 < header.points) continue;
    batch.offset = buffer.position();
    if (batch.points > 0 && (!output.write(&batch, sizeof batch) ||
                             !output.write(records.data(), batch.points * header.stride)))
      return;
    batch.points = 0;
  }
  batch.points = 0;
  laszip_CHAR* why = nullptr;
  if (!good && laszip != nullptr && laszip_get_error(laszip, &why) == 0 && why != nullptr)
    std::snprintf(batch.text.data(), batch.text.size(), "%s", why);
  (void)output.write(&batch, sizeof batch);
}

/// LASzip trusts its files: damaged ones make it read and write where nothing is (version 3.5.0:
/// SIGSEGV in LASreadPoint::read for 3 of 1000 lengths that a file was cut to). So it runs in a
/// child process, whose end is an error of the file, and whose points come through a pipe.
class PackedReader final : public LasRecordReader {
 public:
  PackedReader(const Source& source, const LasHeader& header)
      : name_(source.name), progress_(source.progress), header_(header) {}

  Status start(std::string_view text) {
    const Status started = child_.start(
        kMostMemory, [&](const ChildOutput& output) { unpack(text, header_, output); });
    if (started) return {};
    return make_error("{}: no process can be started to unpack it: {}", name_,
                      started.error().message);
  }

  Result<const char*> next() override {
    if (at_ == batch_.points) {
      RELIEF_TRY(read_batch());
    }
    ++read_;
    return records_.data() + at_++ * header_.stride;
  }

  [[nodiscard]] std::size_t offset() const override { return batch_.offset; }

 private:
  Status read_batch() {
    at_ = 0;
    batch_.points = 0;
    BatchHeader batch;
    RELIEF_TRY(read_all(&batch, sizeof batch));
    batch.text.back() = '\0';
    batch_ = batch;
    if (batch.points == 0 || batch.points > points_of_batch(header_))
      return damaged(batch_.text.data());
    records_.resize(batch.points * header_.stride);
    return read_all(records_.data(), records_.size());
  }

  Status read_all(void* bytes, std::size_t size) {
    switch (child_.read(bytes, size, progress_)) {
      case ConfinedChild::Got::All:
        return {};
      case ConfinedChild::Got::Interrupted:
        return interrupted_error();
      case ConfinedChild::Got::Ended:
        break;
    }
    return damaged("LASzip gave up");
  }

  [[nodiscard]] Error damaged(std::string_view why) const {
    return make_error(
        "{}: byte {}: point {} of {} cannot be unpacked{}{}; the file is truncated or "
        "damaged",
        name_, batch_.offset, read_ + 1, header_.points, why.empty() ? "" : ": ", why);
  }

  std::string name_;
  Progress& progress_;
  LasHeader header_;
  ConfinedChild child_;
  BatchHeader batch_;
  std::vector<char> records_;  // of the batch
  std::size_t at_ = 0;         // the next of them
  std::uint64_t read_ = 0;
};

}  // namespace

Result<LasRecords> open_laz_records(const Source& source, const LasHeader& header) {
  auto reader = std::make_unique<PackedReader>(source, header);
  RELIEF_TRY(reader->start(source.text));
  return LasRecords(std::move(reader));
}

bool can_unpack_laz() {
  return true;
}
#else
Result<LasRecords> open_laz_records(const Source& source, const LasHeader& /*header*/) {
  return make_error(
      "{}: is packed as LAZ (or COPC, which is LAZ too), which this build cannot read: it was "
      "built "
      "without LASzip (Debian 13: liblaszip-dev); unpack it to LAS first, with `laszip -i IN.laz "
      "-o "
      "OUT.las` or `pdal translate IN.laz OUT.las`",
      source.name);
}

bool can_unpack_laz() {
  return false;
}
#endif

}  // namespace relief
