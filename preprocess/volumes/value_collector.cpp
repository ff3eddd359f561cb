#include "preprocess/volumes/value_collector.h"

#include <algorithm>
#include <type_traits>

namespace relief {
namespace {

template <class Real, class Number>
Real value_of(Number number) {
  if constexpr (std::is_floating_point_v<Number> && std::is_same_v<Real, float>) {
    return value_or_nan(number);
  } else {
    return static_cast<Real>(number);
  }
}

template <class Number, class Bits, class Real>
void convert_all(bool is_big_endian, const std::byte* bytes, std::span<Real> values) {
  const char* at = reinterpret_cast<const char*>(bytes);
  if (is_big_endian) {
    for (Real& value : values) {
      value = value_of<Real>(detail::load<Number, Bits, true>(at));
      at += sizeof(Bits);
    }
  } else {
    for (Real& value : values) {
      value = value_of<Real>(detail::load<Number, Bits, false>(at));
      at += sizeof(Bits);
    }
  }
}

}  // namespace

template <class Real>
ValueCollector<Real>::ValueCollector(NumberForm form, std::uint64_t count, std::uint64_t likely)
    : form_(form), count_(count) {
  values_.reserve(std::min(count, likely));
}

template <class Real>
void ValueCollector<Real>::convert(const std::byte* bytes, std::size_t numbers) {
  const std::size_t before = values_.size();
  values_.resize(before + numbers);
  const std::span<Real> values = std::span(values_).subspan(before);
  const bool big = form_.is_big_endian;
  switch (form_.type) {
    case NumberType::Int8:
      return convert_all<std::int8_t, std::uint8_t>(big, bytes, values);
    case NumberType::Uint8:
      return convert_all<std::uint8_t, std::uint8_t>(big, bytes, values);
    case NumberType::Int16:
      return convert_all<std::int16_t, std::uint16_t>(big, bytes, values);
    case NumberType::Uint16:
      return convert_all<std::uint16_t, std::uint16_t>(big, bytes, values);
    case NumberType::Int32:
      return convert_all<std::int32_t, std::uint32_t>(big, bytes, values);
    case NumberType::Uint32:
      return convert_all<std::uint32_t, std::uint32_t>(big, bytes, values);
    case NumberType::Int64:
      return convert_all<std::int64_t, std::uint64_t>(big, bytes, values);
    case NumberType::Uint64:
      return convert_all<std::uint64_t, std::uint64_t>(big, bytes, values);
    case NumberType::Float32:
      return convert_all<float, std::uint32_t>(big, bytes, values);
    case NumberType::Float64:
      return convert_all<double, std::uint64_t>(big, bytes, values);
  }
}

template <class Real>
void ValueCollector<Real>::take(std::span<const std::byte> piece) {
  const std::size_t size = size_of(form_.type);
  if (part_bytes_ > 0) {
    const std::size_t more = std::min(size - part_bytes_, piece.size());
    std::ranges::copy(piece.first(more), part_.begin() + static_cast<std::ptrdiff_t>(part_bytes_));
    part_bytes_ += more;
    piece = piece.subspan(more);
    if (part_bytes_ < size) return;
    convert(part_.data(), 1);
    part_bytes_ = 0;
  }
  const auto numbers = static_cast<std::size_t>(
      std::min<std::uint64_t>(piece.size() / size, count_ - values_.size()));
  convert(piece.data(), numbers);
  piece = piece.subspan(numbers * size);
  if (is_complete()) {
    surplus_ += piece.size();
    return;
  }
  std::ranges::copy(piece, part_.begin());
  part_bytes_ = piece.size();
}

template class ValueCollector<float>;
template class ValueCollector<double>;

}  // namespace relief
