// Lines and numbers of a text that is not trusted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace relief {

/// Walks over a text line by line and, within a line, word by word. Lines end with LF, CR LF or CR.
/// Words are separated by spaces, tabs and whatever else `separators` names. Nothing is copied;
/// line numbers are counted only when an error needs one.
class TextCursor {
 public:
  static constexpr std::string_view kBlanks = " \t\f\v";

  explicit TextCursor(std::string_view text, std::string_view separators = kBlanks,
                      char comment = '\0');

  /// Goes to the next line that has a word in it; false at the end of the text.
  [[nodiscard]] bool next_line();
  /// Goes to `offset`, the start of a line.
  void skip_to(std::size_t offset);
  /// Goes past what is left of the line.
  void skip_line();

  /// Takes a number from the line: decimal, with or without exponent, nan, inf. False, and nothing
  /// taken, if there is none. Values beyond double become infinite or zero.
  [[nodiscard]] bool number(double& value);
  /// Takes an integer, if the next word is one from `least` to what 64 bits hold.
  [[nodiscard]] bool integer(std::int64_t& value, std::int64_t least = INT64_MIN);
  /// Takes a word; empty at the end of the line.
  [[nodiscard]] std::string_view word();
  /// The next word, not taken.
  [[nodiscard]] std::string_view peek();
  /// Whether the line has no more words.
  [[nodiscard]] bool at_line_end();
  /// The rest of the line, without its end; taken.
  [[nodiscard]] std::string_view rest_of_line();

  [[nodiscard]] std::size_t offset() const { return static_cast<std::size_t>(at_ - begin_); }
  [[nodiscard]] std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }
  /// The number of the current line, from 1. Counts: for errors only.
  [[nodiscard]] std::size_t line_number() const;
  /// What stands where a number was expected, as a message: "line 12: expected a number, found
  /// 'x'".
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

/// Reads the whole of `word` as a number, as TextCursor::number does.
[[nodiscard]] bool parse_number(std::string_view word, double& value);

}  // namespace relief
