// Reads lines, words and numbers of untrusted text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace relief {

/// Walks over a text line by line and, within a line, word by word. Lines end with LF, CR LF or CR.
/// Words are separated by spaces, tabs and `separators`. Nothing is copied; lines are counted only
/// when an error needs the number.
class TextCursor {
 public:
  static constexpr std::string_view kBlanks = " \t\f\v";

  explicit TextCursor(std::string_view text, std::string_view separators = kBlanks,
                      char comment = '\0');

  /// Moves to the next line with a word; returns false at the end of the text.
  [[nodiscard]] bool next_line();
  /// Moves to `offset`, the start of a line.
  void skip_to(std::size_t offset);
  /// Skips the rest of the line.
  void skip_line();

  /// Reads a number from the line: decimal, with or without exponent, nan, inf. Returns false and
  /// moves nowhere if there is none. Values beyond double become infinite or zero.
  [[nodiscard]] bool number(double& value);
  /// Reads an integer if the next word is one, from `min` to the largest of 64 bits.
  [[nodiscard]] bool integer(std::int64_t& value, std::int64_t min = INT64_MIN);
  /// Reads a word; empty at the end of the line.
  [[nodiscard]] std::string_view word();
  /// Returns the next word without moving.
  [[nodiscard]] std::string_view peek();
  /// Returns whether the line has no more words.
  [[nodiscard]] bool at_line_end();
  /// Reads the rest of the line, without its end.
  [[nodiscard]] std::string_view rest_of_line();

  [[nodiscard]] std::size_t offset() const { return static_cast<std::size_t>(at_ - begin_); }
  [[nodiscard]] std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }
  /// Returns the number of the current line, from 1. Counts lines: use it only for errors.
  [[nodiscard]] std::size_t line_number() const;
  /// Returns a message about the next word, where a number was expected: "line 12: expected a
  /// number, found 'x'".
  [[nodiscard]] std::string expected(std::string_view what);

 private:
  [[nodiscard]] bool is_separator(char c) const {
    return separator_[static_cast<unsigned char>(c)];
  }
  static bool is_line_end(char c) { return c == '\n' || c == '\r'; }
  [[nodiscard]] bool ends_word(const char* p) const {
    return p == end_ || is_separator(*p) || is_line_end(*p);
  }
  void skip_separators();

  const char* begin_;
  const char* at_;
  const char* end_;
  char comment_;
  bool in_line_ = false;
  bool separator_[256] = {};
};

/// Reads all of `word` as a number, as TextCursor::number does.
[[nodiscard]] bool parse_number(std::string_view word, double& value);

}  // namespace relief
