// Packed LAS files, through LASzip if the build has it. A source of its own: LASzip's header names
// all of namespace std.
#include "preprocess/readers/las/las_point.h"

#ifdef RELIEF_LASZIP
#include <laszip/laszip_api.h>

#include <istream>
#include <streambuf>

#include "common/guard.h"
#endif

namespace relief {

#ifdef RELIEF_LASZIP
namespace {

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
    const off_type base = from == std::ios_base::beg   ? 0
                          : from == std::ios_base::cur ? gptr() - eback()
                                                       : egptr() - eback();
    const off_type to = base + offset;
    if (to < 0 || to > egptr() - eback()) return pos_type(off_type(-1));
    setg(eback(), eback() + to, egptr());
    return pos_type(to);
  }
  pos_type seekpos(pos_type position, std::ios_base::openmode mode) override {
    return seekoff(off_type(position), std::ios_base::beg, mode);
  }
};

class PackedReader final : public LasPointReader {
 public:
  PackedReader(const Source& source, const LasHeader& header)
      : name_(source.name), header_(header), buffer_(source.text), stream_(&buffer_) {}
  ~PackedReader() override {
    if (laszip_ == nullptr) return;
    if (is_open_) laszip_close_reader(laszip_);
    laszip_destroy(laszip_);
  }

  Status open() {
    return guarded(call(), [this]() -> Status {
      laszip_BOOL is_packed = 0;
      if (laszip_create(&laszip_) != 0) return make_error("{}: LASzip does not start", name_);
      if (laszip_open_reader_stream(laszip_, stream_, &is_packed) != 0) return damaged();
      is_open_ = true;
      return laszip_get_point_pointer(laszip_, &point_) != 0 ? damaged() : Status();
    });
  }

  Status next(LasPoint& point) override {
    if (laszip_read_point(laszip_) != 0) return damaged();
    ++read_;
    const laszip_point_struct& p = *point_;
    point.steps = {p.X, p.Y, p.Z};
    const bool wide = header_.is_wide();
    const unsigned number = wide ? p.extended_return_number : p.return_number;
    const unsigned returns = wide ? p.extended_number_of_returns : p.number_of_returns;
    point.return_number = static_cast<std::uint8_t>(std::max(number, 1U));
    point.returns = static_cast<std::uint8_t>(std::max(returns, 1U));
    point.is_withheld =
        wide ? (p.extended_classification_flags & 0x04U) != 0 : p.withheld_flag != 0;
    point.point_class = wide ? p.extended_classification : p.classification;
    point.colour = {p.rgb[0], p.rgb[1], p.rgb[2]};
    return {};
  }

  [[nodiscard]] std::size_t offset() const override { return buffer_.position(); }

 private:
  [[nodiscard]] GuardedCall call() const {
    return {.subject = name_,
            .task = "unpack it",
            .library = "LASzip",
            .advice = "the file may be damaged: unpack it to LAS with another program",
            .memory_advice = kMoreMemory};
  }

  [[nodiscard]] Error damaged() const {
    laszip_CHAR* why = nullptr;
    if (laszip_get_error(laszip_, &why) != 0 || why == nullptr) why = nullptr;
    return make_error("{}: byte {}: point {} of {} cannot be unpacked{}{}; the file is truncated or "
                      "damaged",
                      name_, buffer_.position(), read_ + 1, header_.points,
                      why == nullptr ? "" : ": ", why == nullptr ? "" : why);
  }

  std::string name_;
  LasHeader header_;
  TextBuffer buffer_;
  std::istream stream_;
  laszip_POINTER laszip_ = nullptr;
  laszip_point_struct* point_ = nullptr;
  bool is_open_ = false;
  std::uint64_t read_ = 0;
};

}  // namespace

Result<LasPoints> open_laz_points(const Source& source, const LasHeader& header) {
  auto reader = std::make_unique<PackedReader>(source, header);
  RELIEF_TRY(reader->open());
  return LasPoints(std::move(reader));
}

bool can_unpack_laz() {
  return true;
}
#else
Result<LasPoints> open_laz_points(const Source& source, const LasHeader& /*header*/) {
  return make_error(
      "{}: is packed as LAZ (or COPC, which is LAZ too), which this build cannot read: it was built "
      "without LASzip (Debian 13: liblaszip-dev); unpack it to LAS first, with `laszip -i IN.laz -o "
      "OUT.las` or `pdal translate IN.laz OUT.las`",
      source.name);
}

bool can_unpack_laz() {
  return false;
}
#endif

}  // namespace relief
