#include "preprocess/volumes/volume_values.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "preprocess/readers/source.h"
#include "preprocess/readers/text_cursor.h"
#include "preprocess/volumes/value_collector.h"

namespace relief {
namespace {

/// Converting a megabyte takes about a millisecond.
constexpr std::size_t kValueStep = std::size_t{1} << 20U;

/// Advances a progress to numbers of bytes that only grow.
class BytesMeter {
 public:
  explicit BytesMeter(Progress& progress) : progress_(progress) {}
  void advance_to(std::size_t bytes) {
    progress_.advance(bytes - reported_);
    reported_ = bytes;
  }

 private:
  Progress& progress_;
  std::size_t reported_ = 0;
};

/// The CRC-32 of bytes that come in pieces.
class RunningChecksum {
 public:
  void take(std::span<const std::byte> piece) {
    value_ = ::crc32(value_, reinterpret_cast<const Bytef*>(piece.data()),
                     static_cast<uInt>(piece.size()));
  }
  [[nodiscard]] Status check(const std::string& name, const ValueBlock& block) const {
    if (!block.checksum || *block.checksum == value_) return {};
    return make_error("{}: its checksum does not match; the file is damaged", name);
  }

 private:
  uLong value_ = ::crc32(0, nullptr, 0);
};

template <class Real>
Result<std::vector<Real>> read_plain(const std::string& name, std::span<const std::byte> bytes,
                                     const ValueBlock& block, Progress& progress) {
  const std::size_t size = size_of(block.form.type);
  bytes = bytes.subspan(std::min<std::uint64_t>(block.skip, bytes.size()));
  if (bytes.size() / size < block.count) return too_few_values(name, block, bytes.size());
  if (bytes.size() - block.count * size > block.most_surplus) return too_many_values(name, block);
  bytes = bytes.first(block.count * size);
  ValueCollector<Real> collector(block.form, block.count, block.count);
  BytesMeter meter(progress);
  RunningChecksum checksum;
  for (std::size_t at = 0; at < bytes.size(); at += kValueStep) {
    if (progress.cancelled()) return interrupted_error();
    const auto piece = bytes.subspan(at, std::min(kValueStep, bytes.size() - at));
    if (block.checksum) checksum.take(piece);
    collector.take(piece);
    meter.advance_to(at + piece.size());
  }
  if (block.checksum) RELIEF_TRY(checksum.check(name, block));
  return collector.release();
}

template <class Real>
Result<std::vector<Real>> read_packed(const std::string& name, std::span<const std::byte> bytes,
                                      const ValueBlock& block, Progress& progress) {
  const std::size_t size = size_of(block.form.type);
  if (block.count / kDeflateRatio > bytes.size() / size + 1)
    return too_few_values(name, block, bytes.size());
  ValueCollector<Real> collector(block.form, block.count, kLikelyVolumeRatio * bytes.size() / size);
  BytesMeter meter(progress);
  RunningChecksum checksum;
  std::uint64_t skip = block.skip;
  RELIEF_TRY(inflate_pieces(
      name, bytes, *block.packing, progress,
      [&](std::span<const std::byte> piece, std::size_t used) -> Result<bool> {
        meter.advance_to(used);
        if (block.checksum) checksum.take(piece);
        const auto skipped = static_cast<std::size_t>(std::min<std::uint64_t>(skip, piece.size()));
        skip -= skipped;
        collector.take(piece.subspan(skipped));
        if (collector.surplus() > block.most_surplus) return too_many_values(name, block);
        return true;
      }));
  if (!collector.is_complete()) return too_few_values(name, block, collector.taken());
  if (block.checksum) RELIEF_TRY(checksum.check(name, block));
  return collector.release();
}

}  // namespace

Error too_few_values(const std::string& name, const ValueBlock& block, std::uint64_t found) {
  return make_error(
      "{}: holds {} bytes of values, but its header or layout states {} values of {} bits; the "
      "file is truncated, or the header's size or type is wrong",
      name, found, block.count, 8 * size_of(block.form.type));
}

Error too_many_values(const std::string& name, const ValueBlock& block) {
  return make_error(
      "{}: holds more than the {} values of {} bits that its header or layout states; the "
      "header's size or type is wrong",
      name, block.count, 8 * size_of(block.form.type));
}

template <class Real>
Result<std::vector<Real>> read_values(const std::string& name, std::span<const std::byte> bytes,
                                      const ValueBlock& block, Progress& progress) {
  return block.packing ? read_packed<Real>(name, bytes, block, progress)
                       : read_plain<Real>(name, bytes, block, progress);
}

template <class Real>
Result<std::vector<Real>> read_text_values(const std::string& name, std::string_view text,
                                           std::uint64_t count, const Progress& progress) {
  // A number has a digit and a separator.
  if (count > text.size() / 2 + 1) {
    return make_error(
        "{}: states {} values, which its {} bytes of text cannot hold; the file is truncated or "
        "its header is wrong",
        name, count, text.size());
  }
  std::vector<Real> values;
  values.reserve(count);
  TextCursor cursor(text, " \t\f\v,");
  while (values.size() < count) {
    if (values.size() % 65536 == 0 && progress.cancelled()) return interrupted_error();
    double value = 0.0;
    if (cursor.number(value)) {
      const bool has_value =
          std::is_same_v<Real, double> || std::abs(value) <= std::numeric_limits<float>::max();
      values.push_back(has_value ? static_cast<Real>(value)
                                 : std::numeric_limits<Real>::quiet_NaN());
    } else if (!cursor.at_line_end()) {
      return make_error("{}: value {}: expected a number, found {}", name, values.size() + 1,
                        relief::quoted(cursor.peek()));
    } else if (!cursor.next_line()) {
      return make_error(
          "{}: states {} values, but its text ends after {}; the file is truncated or its header "
          "is wrong",
          name, count, values.size());
    }
  }
  return values;
}

template Result<std::vector<float>> read_values(const std::string&, std::span<const std::byte>,
                                                const ValueBlock&, Progress&);
template Result<std::vector<double>> read_values(const std::string&, std::span<const std::byte>,
                                                 const ValueBlock&, Progress&);
template Result<std::vector<float>> read_text_values(const std::string&, std::string_view,
                                                     std::uint64_t, const Progress&);
template Result<std::vector<double>> read_text_values(const std::string&, std::string_view,
                                                      std::uint64_t, const Progress&);

}  // namespace relief
