// Walks over the lines of a text header.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace relief {

/// Gives a header's lines one by one; they end with LF or CR LF.
class HeaderLines {
 public:
  explicit HeaderLines(std::string_view text) : text_(text) {}

  /// Reads the next line, without its end. Returns false at the end of the text.
  [[nodiscard]] bool next(std::string_view& line) {
    if (offset_ == text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', offset_), text_.size());
    line = text_.substr(offset_, end - offset_);
    if (line.ends_with('\r')) line.remove_suffix(1);
    offset_ = std::min(end + 1, text_.size());
    ++number_;
    return true;
  }

  /// Where the next line begins, bytes.
  [[nodiscard]] std::size_t offset() const { return offset_; }
  /// Number of the line that was read last, from 1.
  [[nodiscard]] std::size_t number() const { return number_; }

 private:
  std::string_view text_;
  std::size_t offset_ = 0;
  std::size_t number_ = 0;
};

}  // namespace relief
