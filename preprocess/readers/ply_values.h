// The numbers of a PLY body, one by one, in each of its encodings. Nothing is read beyond the end.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "preprocess/readers/ply_header.h"
#include "preprocess/readers/text_cursor.h"

namespace relief {

/// An ASCII body: one line per element, as the format demands; blank lines are passed over.
class PlyAsciiValues {
 public:
  PlyAsciiValues(std::string_view text, std::size_t body) : text_(text) { text_.skip_to(body); }

  [[nodiscard]] bool begin_element() { return text_.next_line(); }
  [[nodiscard]] bool value(PlyType /*type*/, double& value) { return text_.number(value); }
  [[nodiscard]] bool end_element() { return text_.at_line_end(); }
  [[nodiscard]] bool skip_values(PlyType /*type*/, std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) {
      if (text_.word().empty()) return false;
    }
    return true;
  }

  /// The least number of bytes that one value takes: a digit and what separates it from the next.
  [[nodiscard]] static std::uint64_t least_size(PlyType /*type*/) { return 2; }
  /// One more than there are: the last number of a text needs no separator.
  [[nodiscard]] std::uint64_t left() const { return text_.left() + 1; }
  [[nodiscard]] std::size_t offset() const { return text_.offset(); }
  /// Where and why the last call returned false.
  [[nodiscard]] std::string failure() {
    return text_.expected(text_.at_line_end() ? "a number" : "a number or the line's end");
  }

 private:
  TextCursor text_;
};

/// A binary body.
template <bool BigEndian>
class PlyBinaryValues {
 public:
  PlyBinaryValues(std::string_view text, std::size_t body) : text_(text), offset_(body) {}

  [[nodiscard]] bool begin_element() { return true; }
  [[nodiscard]] bool end_element() { return true; }
  [[nodiscard]] bool value(PlyType type, double& value) {
    if (left() < size_of(type)) return false;
    switch (type) {
      case PlyType::Int8:
        value = take<std::int8_t, std::uint8_t>();
        break;
      case PlyType::Uint8:
        value = take<std::uint8_t, std::uint8_t>();
        break;
      case PlyType::Int16:
        value = take<std::int16_t, std::uint16_t>();
        break;
      case PlyType::Uint16:
        value = take<std::uint16_t, std::uint16_t>();
        break;
      case PlyType::Int32:
        value = take<std::int32_t, std::uint32_t>();
        break;
      case PlyType::Uint32:
        value = take<std::uint32_t, std::uint32_t>();
        break;
      case PlyType::Float32:
        value = static_cast<double>(take<float, std::uint32_t>());
        break;
      case PlyType::Float64:
        value = take<double, std::uint64_t>();
        break;
    }
    return true;
  }
  [[nodiscard]] bool skip_values(PlyType type, std::uint64_t count) {
    if (count > left() / size_of(type)) return false;
    offset_ += count * size_of(type);
    return true;
  }

  [[nodiscard]] static std::uint64_t least_size(PlyType type) { return size_of(type); }
  [[nodiscard]] std::uint64_t left() const { return text_.size() - offset_; }
  [[nodiscard]] std::size_t offset() const { return offset_; }
  [[nodiscard]] std::string failure() const {
    return fmt::format("byte {}: the data ends early", offset_);
  }

 private:
  template <class Number, class Bits>
  Number take() {
    Bits bits = 0;
    for (std::size_t i = 0; i < sizeof(Bits); ++i) {
      const std::size_t shift = 8 * (BigEndian ? sizeof(Bits) - 1 - i : i);
      const auto byte = static_cast<unsigned char>(text_[offset_ + i]);
      bits = static_cast<Bits>(bits | (static_cast<Bits>(byte) << shift));
    }
    offset_ += sizeof(Bits);
    return std::bit_cast<Number>(bits);
  }

  std::string_view text_;
  std::size_t offset_;
};

}  // namespace relief
