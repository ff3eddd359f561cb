// Packed LAS files, through LASzip if the build has it. A source of its own: LASzip's header names
// all of namespace std.
#include "preprocess/readers/las/las_point.h"

#ifdef RELIEF_LASZIP
#include <fcntl.h>
#include <laszip/laszip_api.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <istream>
#include <streambuf>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>
#endif

namespace relief {

#ifdef RELIEF_LASZIP
namespace {

/// Records that the child writes at a time take about so much.
constexpr std::size_t kBatchBytes = 65536;
constexpr int kWaitMilliseconds = 100;
/// Memory that LASzip may take beside the file.
constexpr rlim_t kMostMemory = rlim_t{2} << 30U;

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

bool write_all(int pipe, const void* bytes, std::size_t size) {
  const char* at = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t put = ::write(pipe, at, size);
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) return false;
    at += put;
    size -= static_cast<std::size_t>(put);
  }
  return true;
}

/// Unpacks the points into a pipe, in the child.
void unpack(std::string_view text, const LasHeader& header, int pipe) {
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
    if (batch.points > 0 && (!write_all(pipe, &batch, sizeof batch) ||
                             !write_all(pipe, records.data(), batch.points * header.stride)))
      return;
    batch.points = 0;
  }
  batch.points = 0;
  laszip_CHAR* why = nullptr;
  if (!good && laszip != nullptr && laszip_get_error(laszip, &why) == 0 && why != nullptr)
    std::snprintf(batch.text.data(), batch.text.size(), "%s", why);
  (void)write_all(pipe, &batch, sizeof batch);
}

/// Limits the child and makes it end with its parent.
void confine() {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::signal(SIGPIPE, SIG_DFL);
  for (const int fault : {SIGSEGV, SIGBUS, SIGFPE, SIGABRT}) ::signal(fault, SIG_DFL);
  const struct rlimit no_core { 0, 0 };
  ::setrlimit(RLIMIT_CORE, &no_core);
  unsigned long pages = 0;
  if (FILE* const size = std::fopen("/proc/self/statm", "r"); size != nullptr) {
    if (std::fscanf(size, "%lu", &pages) != 1) pages = 0;
    std::fclose(size);
  }
  if (pages == 0) return;
  const rlim_t most = pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + kMostMemory;
  const struct rlimit memory { most, most };
  ::setrlimit(RLIMIT_AS, &memory);
}

/// LASzip trusts its files: damaged ones make it read and write where nothing is (version 3.5.0:
/// SIGSEGV in LASreadPoint::read for 3 of 1000 lengths that a file was cut to). So it runs in a
/// child process, whose end is an error of the file, and whose points come through a pipe.
class PackedReader final : public LasRecordReader {
 public:
  PackedReader(const Source& source, const LasHeader& header)
      : name_(source.name), progress_(source.progress), header_(header) {}
  ~PackedReader() override {
    if (pipe_ >= 0) ::close(pipe_);
    if (child_ <= 0) return;
    ::kill(child_, SIGKILL);
    while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }

  Status start(std::string_view text) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
      return make_error("{}: no process can be started to unpack it: {}", name_,
                        std::strerror(errno));
    child_ = ::fork();
    if (child_ == 0) {
      ::close(ends[0]);
      confine();
      try {
        unpack(text, header_, ends[1]);
      } catch (...) {
        ::_exit(1);
      }
      ::_exit(0);
    }
    ::close(ends[1]);
    pipe_ = ends[0];
    if (child_ > 0) return {};
    return make_error("{}: no process can be started to unpack it: {}", name_,
                      std::strerror(errno));
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
    for (char* at = static_cast<char*>(bytes); size > 0;) {
      if (progress_.cancelled()) return interrupted_error();
      struct pollfd wait {
        pipe_, POLLIN, 0
      };
      const int ready = ::poll(&wait, 1, kWaitMilliseconds);
      if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
      const ssize_t got = ::read(pipe_, at, size);
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) return damaged("LASzip gave up");
      at += got;
      size -= static_cast<std::size_t>(got);
    }
    return {};
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
  pid_t child_ = -1;
  int pipe_ = -1;
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
