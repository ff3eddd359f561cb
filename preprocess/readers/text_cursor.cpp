#include "preprocess/readers/text_cursor.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "preprocess/readers/source.h"

namespace relief {

bool parse_number(std::string_view word, double& value) {
  const char* const end = word.data() + word.size();
  const char* p = word.data();
  // from_chars knows no plus sign.
  if (p != end && *p == '+') ++p;
  if (p == end || (p != word.data() && *p == '-')) return false;
  const auto [stop, code] = std::from_chars(p, end, value);
  if (code == std::errc::result_out_of_range && stop == end) {
    const bool tiny = word.find("e-") != word.npos || word.find("E-") != word.npos ||
                      word.find('.') < word.find_first_of("123456789");
    value = tiny ? 0.0 : std::numeric_limits<double>::infinity();
    return true;
  }
  if (code != std::errc{}) return false;
  if (stop == end) return true;
  // Microsoft's C library used to write 1.#QNAN, -1.#IND and 1.#INF.
  if (*stop == '#') {
    value = std::numeric_limits<double>::quiet_NaN();
    return true;
  }
  return false;
}

TextCursor::TextCursor(std::string_view text, std::string_view separators, char comment)
    : begin_(text.data()), at_(text.data()), end_(text.data() + text.size()), comment_(comment) {
  for (const char c : separators) separator_[static_cast<unsigned char>(c)] = true;
}

bool TextCursor::next_line() {
  if (in_line_) skip_line();
  in_line_ = true;
  for (;;) {
    skip_separators();
    if (at_ == end_) return false;
    if (*at_ == comment_ && comment_ != '\0') skip_line();
    if (at_ == end_) return false;
    if (!is_line_end(*at_)) return true;
    ++at_;
  }
}

void TextCursor::skip_to(std::size_t offset) {
  at_ = begin_ + offset;
  in_line_ = false;
}

void TextCursor::skip_line() {
  while (at_ != end_ && !is_line_end(*at_)) ++at_;
}

bool TextCursor::number(double& value) {
  skip_separators();
  // Small integers are most of a mesh's text; from_chars takes three times as long for them.
  const char* p = at_;
  std::uint32_t digits = 0;
  while (p != end_ && *p >= '0' && *p <= '9' && p - at_ < 9) {
    digits = digits * 10 + static_cast<std::uint32_t>(*p++ - '0');
  }
  if (p != at_ && ends_word(p)) {
    value = digits;
    at_ = p;
    return true;
  }
  const std::string_view next = peek();
  if (next.empty() || !parse_number(next, value)) return false;
  at_ += next.size();
  return true;
}

bool TextCursor::integer(std::int64_t& value, std::int64_t min) {
  const std::string_view next = peek();
  const auto [stop, code] = std::from_chars(next.data(), next.data() + next.size(), value);
  if (code != std::errc{} || stop != next.data() + next.size() || value < min) return false;
  at_ += next.size();
  return true;
}

std::string_view TextCursor::word() {
  const std::string_view next = peek();
  at_ += next.size();
  return next;
}

std::string_view TextCursor::peek() {
  skip_separators();
  const char* p = at_;
  if (p != end_ && *p == comment_ && comment_ != '\0') return {};
  while (!ends_word(p)) ++p;
  return {at_, static_cast<std::size_t>(p - at_)};
}

bool TextCursor::at_line_end() {
  return peek().empty();
}

std::string_view TextCursor::rest_of_line() {
  skip_separators();
  const char* const from = at_;
  skip_line();
  return {from, static_cast<std::size_t>(at_ - from)};
}

void TextCursor::skip_separators() {
  while (at_ != end_ && is_separator(*at_)) {
    const bool continues = *at_++ == '\\';
    if (!continues) continue;
    if (at_ != end_ && *at_ == '\r') ++at_;
    if (at_ != end_ && *at_ == '\n') ++at_;
  }
}

std::size_t TextCursor::line_number() const {
  std::size_t lines = 1;
  for (const char* p = begin_; p != at_; ++p) {
    // CR LF is one line end: count its LF.
    if (*p == '\n' || (*p == '\r' && (p + 1 == end_ || p[1] != '\n'))) ++lines;
  }
  return lines;
}

std::string TextCursor::expected(std::string_view what) {
  const std::string_view found = peek();
  if (!found.empty()) {
    return fmt::format("line {}: expected {}, found {}", line_number(), what,
                       relief::quoted(found));
  }
  return fmt::format("line {}: expected {}, but the {} ends", line_number(), what,
                     at_ == end_ ? "file" : "line");
}

}  // namespace relief
