#include "preprocess/readers/las/las_scalars.h"

#include <array>
#include <limits>
#include <string_view>
#include <utility>

namespace relief {
namespace {

/// An extra-bytes record: user id LASF_Spec, record id 4.
constexpr std::uint16_t kExtraBytesRecord = 4;
constexpr std::size_t kVlrHeader = 54;
constexpr std::size_t kExtraDescription = 192;  ///< bytes that describe one scalar
/// Offsets in the file's header.
constexpr std::size_t kHeaderSizeAt = 94;
constexpr std::size_t kVlrCountAt = 100;

/// Offsets in a description.
constexpr std::size_t kExtraType = 2;
constexpr std::size_t kExtraOptions = 3;
constexpr std::size_t kExtraName = 4;
constexpr std::size_t kExtraNameBytes = 32;
constexpr std::size_t kExtraNoData = 40;
constexpr std::size_t kExtraScale = 112;
constexpr std::size_t kExtraOffset = 136;
/// Bits of the options.
constexpr unsigned kHasNoData = 0x01;
constexpr unsigned kHasScale = 0x08;
constexpr unsigned kHasOffset = 0x10;

/// Types 1 to 10.
constexpr std::array kExtraTypes{NumberType::Uint8,  NumberType::Int8,   NumberType::Uint16,
                                 NumberType::Int16,  NumberType::Uint32, NumberType::Int32,
                                 NumberType::Uint64, NumberType::Int64,  NumberType::Float32,
                                 NumberType::Float64};

std::vector<LasScalar> standard_scalars(const LasHeader& header) {
  const bool wide = header.is_wide();
  std::vector<LasScalar> scalars{
      {"intensity", 12, NumberType::Uint16},
      {"return_number", 14, NumberType::Uint8, 0, wide ? 0x0FU : 0x07U},
      {"number_of_returns", 14, NumberType::Uint8, wide ? 4U : 3U, wide ? 0x0FU : 0x07U},
      wide ? LasScalar{"classification", 16, NumberType::Uint8}
           : LasScalar{"classification", 15, NumberType::Uint8, 0, 0x1FU},
      wide ? LasScalar{"scan_angle", 18, NumberType::Int16, 0, 0, 0.006}
           : LasScalar{"scan_angle", 16, NumberType::Int8},
      {"user_data", 17, NumberType::Uint8},
      {"point_source_id", wide ? std::size_t{20} : std::size_t{18}, NumberType::Uint16}};
  if (const std::size_t at = header.time_at(); at > 0)
    scalars.push_back({"gps_time", at, NumberType::Float64});
  return scalars;
}

/// One description; `at`: where its bytes begin in a point. Nothing if it is no single number.
std::optional<LasScalar> describe(const char* bytes, std::size_t at) {
  const auto type = load_whole<std::uint8_t>(bytes + kExtraType);
  if (type == 0 || type > kExtraTypes.size()) return std::nullopt;
  std::string_view name(bytes + kExtraName, kExtraNameBytes);
  name = name.substr(0, name.find('\0'));
  if (name.empty()) return std::nullopt;
  LasScalar scalar{file_scalar_name(name), at, kExtraTypes[type - 1U]};
  const auto options = load_whole<std::uint8_t>(bytes + kExtraOptions);
  const auto number = [bytes](std::size_t where) {
    return load_number<false>(NumberType::Float64, bytes + where);
  };
  if ((options & kHasScale) != 0) scalar.scale = number(kExtraScale);
  if ((options & kHasOffset) != 0) scalar.offset = number(kExtraOffset);
  if ((options & kHasNoData) != 0) {
    // In the widest type of its kind.
    const bool is_signed = scalar.type == NumberType::Int8 || scalar.type == NumberType::Int16 ||
                           scalar.type == NumberType::Int32 || scalar.type == NumberType::Int64;
    const NumberType widest = is_real(scalar.type)
                                  ? NumberType::Float64
                                  : (is_signed ? NumberType::Int64 : NumberType::Uint64);
    scalar.no_data = load_number<false>(widest, bytes + kExtraNoData);
  }
  return scalar;
}

/// Bytes of an extra-bytes field. Type 0 states its size in the options; 11 to 30 are pairs and
/// triples of the others.
std::size_t bytes_of(const char* description) {
  const auto type = load_whole<std::uint8_t>(description + kExtraType);
  if (type == 0) return load_whole<std::uint8_t>(description + kExtraOptions);
  if (type > 3 * kExtraTypes.size()) return 0;
  return size_of(kExtraTypes[(type - 1U) % kExtraTypes.size()]) *
         (1U + (type - 1U) / kExtraTypes.size());
}

void append_described(const char* record, std::size_t bytes, const LasHeader& header,
                      std::vector<LasScalar>& scalars) {
  std::size_t at = header.standard_bytes();
  for (std::size_t d = 0; d + kExtraDescription <= bytes; d += kExtraDescription) {
    const std::size_t size = bytes_of(record + d);
    if (size == 0 || size > header.stride - at) return;
    if (auto scalar = describe(record + d, at)) scalars.push_back(*std::move(scalar));
    at += size;
  }
}

/// read_las_header has checked that all records fit.
void append_extra_bytes(const Source& source, const LasHeader& header,
                        std::vector<LasScalar>& scalars) {
  const char* const text = source.text.data();
  std::size_t at = load_whole<std::uint16_t>(text + kHeaderSizeAt);
  for (auto left = load_whole<std::uint32_t>(text + kVlrCountAt); left > 0; --left) {
    const std::size_t bytes = load_whole<std::uint16_t>(text + at + 20);
    const bool is_ours = std::string_view(text + at + 2, 10) == std::string_view("LASF_Spec\0", 10);
    if (is_ours && load_whole<std::uint16_t>(text + at + 18) == kExtraBytesRecord)
      return append_described(text + at + kVlrHeader, bytes, header, scalars);
    at += kVlrHeader + bytes;
  }
}

}  // namespace

double LasScalar::of(const char* record) const {
  double number = load_number<false>(type, record + at);
  if (mask != 0) number = (static_cast<std::uint32_t>(number) >> shift) & mask;
  if (no_data && number == *no_data) return std::numeric_limits<double>::quiet_NaN();
  return scale * number + offset;
}

std::vector<LasScalar> find_las_scalars(const Source& source, const LasHeader& header) {
  std::vector<LasScalar> scalars = standard_scalars(header);
  append_extra_bytes(source, header, scalars);
  std::erase_if(scalars,
                [&source](const LasScalar& scalar) { return !source.takes_scalar(scalar.name); });
  return scalars;
}

}  // namespace relief
