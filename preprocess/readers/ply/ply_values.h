// Reads the numbers of a PLY body, one by one, in all encodings. Never reads beyond the end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "preprocess/readers/ply/ply_header.h"
#include "preprocess/readers/text_cursor.h"

namespace relief {

/// An ASCII body: one line per element, as the format requires; blank lines are skipped.
class PlyAsciiValues {
 public:
  PlyAsciiValues(std::string_view text, std::size_t body) : text_(text) { text_.skip_to(body); }

  [[nodiscard]] bool begin_element() {
    ended_ = false;
    return text_.next_line();
  }
  [[nodiscard]] bool value(NumberType /*type*/, double& value) { return text_.number(value); }
  [[nodiscard]] bool end_element() {
    ended_ = true;
    return text_.at_line_end();
  }
  [[nodiscard]] bool skip_values(NumberType /*type*/, std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) {
      if (text_.word().empty()) return false;
    }
    return true;
  }

  /// The minimum number of bytes of a value: a digit and a separator.
  [[nodiscard]] static std::uint64_t min_size(NumberType /*type*/) { return 2; }
  /// One more than the file has: the last number of a text needs no separator.
  [[nodiscard]] std::uint64_t left() const { return text_.left() + 1; }
  [[nodiscard]] std::size_t offset() const { return text_.offset(); }
  /// Returns where and why the last call returned false.
  [[nodiscard]] std::string failure() {
    return text_.expected(ended_ ? "the line's end" : "a number");
  }
  [[nodiscard]] std::string where() const { return fmt::format("line {}", text_.line_number()); }

 private:
  TextCursor text_;
  bool ended_ = false;  ///< whether a number of the element was missing
};

/// A binary body.
template <bool BigEndian>
class PlyBinaryValues {
 public:
  PlyBinaryValues(std::string_view text, std::size_t body) : text_(text), offset_(body) {}

  [[nodiscard]] bool begin_element() { return true; }
  [[nodiscard]] bool end_element() { return true; }
  [[nodiscard]] bool value(NumberType type, double& value) {
    if (left() < size_of(type)) return false;
    value = load_number<BigEndian>(type, text_.data() + offset_);
    offset_ += size_of(type);
    return true;
  }
  [[nodiscard]] bool skip_values(NumberType type, std::uint64_t count) {
    if (count > left() / size_of(type)) return false;
    offset_ += count * size_of(type);
    return true;
  }

  [[nodiscard]] static std::uint64_t min_size(NumberType type) { return size_of(type); }
  [[nodiscard]] std::uint64_t left() const { return text_.size() - offset_; }
  [[nodiscard]] std::size_t offset() const { return offset_; }
  [[nodiscard]] std::string failure() const { return where() + ": the data end early"; }
  [[nodiscard]] std::string where() const { return fmt::format("byte {}", offset_); }

 private:
  std::string_view text_;
  std::size_t offset_;
};

}  // namespace relief
