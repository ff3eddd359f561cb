#include "preprocess/readers/las/las_point.h"

#include "preprocess/readers/number_type.h"

namespace relief {
namespace {

/// Offsets in a point record (LAS 1.4 R15, tables 7 to 17).
constexpr std::size_t kReturns = 14;
constexpr std::size_t kFlags = 15;      ///< of formats 0 to 5 with the class
constexpr std::size_t kWideClass = 16;  ///< of formats 6 to 10

class PlainReader final : public LasRecordReader {
 public:
  PlainReader(const Source& source, const LasHeader& header)
      : text_(source.text), stride_(header.stride), at_(header.body) {}

  Result<const char*> next() override {
    const char* const record = text_.data() + at_;
    at_ += stride_;
    return record;
  }
  [[nodiscard]] std::size_t offset() const override { return at_; }

 private:
  std::string_view text_;
  std::size_t stride_;
  std::size_t at_;
};

}  // namespace

LasPoint read_las_point(const char* record, const LasHeader& header) {
  LasPoint point;
  point.steps = {load_whole<std::int32_t>(record), load_whole<std::int32_t>(record + 4),
                 load_whole<std::int32_t>(record + 8)};
  const auto returns = load_whole<std::uint8_t>(record + kReturns);
  const auto flags = load_whole<std::uint8_t>(record + kFlags);
  const bool wide = header.is_wide();
  const unsigned number = returns & (wide ? 0x0FU : 0x07U);
  const unsigned count = wide ? returns >> 4U : (returns >> 3U) & 0x07U;
  point.return_number = static_cast<std::uint8_t>(std::max(number, 1U));
  point.returns = static_cast<std::uint8_t>(std::max(count, 1U));
  point.is_withheld = (flags & (wide ? 0x04U : 0x80U)) != 0;
  point.point_class = wide ? load_whole<std::uint8_t>(record + kWideClass)
                           : static_cast<std::uint8_t>(flags & 0x1FU);
  if (const std::size_t at = header.colour_at(); at > 0) {
    point.colour = {load_whole<std::uint16_t>(record + at),
                    load_whole<std::uint16_t>(record + at + 2),
                    load_whole<std::uint16_t>(record + at + 4)};
  }
  return point;
}

LasRecords open_las_records(const Source& source, const LasHeader& header) {
  return std::make_unique<PlainReader>(source, header);
}

}  // namespace relief
