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

constexpr std::uint32_t kBatchPoints = 1024;
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
static_assert(std::is_trivially_copyable_v<LasPoint> && std::is_trivially_copyable_v<BatchHeader>);

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

LasPoint point_of(const laszip_point_struct& p, bool is_wide) {
  LasPoint point;
  point.steps = {p.X, p.Y, p.Z};
  const unsigned number = is_wide ? p.extended_return_number : p.return_number;
  const unsigned returns = is_wide ? p.extended_number_of_returns : p.number_of_returns;
  point.return_number = static_cast<std::uint8_t>(std::max(number, 1U));
  point.returns = static_cast<std::uint8_t>(std::max(returns, 1U));
  point.is_withheld =
      is_wide ? (p.extended_classification_flags & 0x04U) != 0 : p.withheld_flag != 0;
  point.point_class = is_wide ? p.extended_classification : p.classification;
  point.colour = {p.rgb[0], p.rgb[1], p.rgb[2]};
  return point;
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
  std::vector<LasPoint> points;
  points.reserve(kBatchPoints);
  bool good = laszip_create(&laszip) == 0 &&
              laszip_open_reader_stream(laszip, stream, &is_packed) == 0 &&
              laszip_get_point_pointer(laszip, &point) == 0;
  for (std::uint64_t i = 0; good && i < header.points; ++i) {
    good = laszip_read_point(laszip) == 0;
    if (good) points.push_back(point_of(*point, header.is_wide()));
    if (points.size() < kBatchPoints && good && i + 1 < header.points) continue;
    batch.points = static_cast<std::uint32_t>(points.size());
    batch.offset = buffer.position();
    if (batch.points > 0 && (!write_all(pipe, &batch, sizeof batch) ||
                             !write_all(pipe, points.data(), points.size() * sizeof(LasPoint))))
      return;
    points.clear();
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
class PackedReader final : public LasPointReader {
 public:
  PackedReader(const Source& source, const LasHeader& header)
      : name_(source.name), progress_(source.progress), count_(header.points) {}
  ~PackedReader() override {
    if (pipe_ >= 0) ::close(pipe_);
    if (child_ <= 0) return;
    ::kill(child_, SIGKILL);
    while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }

  Status start(std::string_view text, const LasHeader& header) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
      return make_error("{}: no process can be started to unpack it: {}", name_,
                        std::strerror(errno));
    child_ = ::fork();
    if (child_ == 0) {
      ::close(ends[0]);
      confine();
      try {
        unpack(text, header, ends[1]);
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

  Status next(LasPoint& point) override {
    if (at_ == points_.size()) {
      RELIEF_TRY(read_batch());
    }
    point = points_[at_++];
    ++read_;
    return {};
  }

  [[nodiscard]] std::size_t offset() const override { return batch_.offset; }

 private:
  Status read_batch() {
    points_.clear();
    at_ = 0;
    BatchHeader batch;
    RELIEF_TRY(read_all(&batch, sizeof batch));
    batch_ = batch;
    batch_.text.back() = '\0';
    if (batch.points == 0 || batch.points > kBatchPoints) return damaged(batch_.text.data());
    points_.resize(batch.points);
    return read_all(points_.data(), points_.size() * sizeof(LasPoint));
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
        name_, batch_.offset, read_ + 1, count_, why.empty() ? "" : ": ", why);
  }

  std::string name_;
  Progress& progress_;
  std::uint64_t count_;
  pid_t child_ = -1;
  int pipe_ = -1;
  BatchHeader batch_;
  std::vector<LasPoint> points_;
  std::size_t at_ = 0;
  std::uint64_t read_ = 0;
};

}  // namespace

Result<LasPoints> open_laz_points(const Source& source, const LasHeader& header) {
  auto reader = std::make_unique<PackedReader>(source, header);
  RELIEF_TRY(reader->start(source.text, header));
  return LasPoints(std::move(reader));
}

bool can_unpack_laz() {
  return true;
}
#else
Result<LasPoints> open_laz_points(const Source& source, const LasHeader& /*header*/) {
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
