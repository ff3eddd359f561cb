#include "renderer/gl/shader/preprocess_shader.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>
#include <vector>

namespace relief {
namespace {

using Macros = std::map<std::string, std::string, std::less<>>;

constexpr std::string_view kBlanks = " \t\r";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// Takes letters, digits and underscores off the front.
std::string_view take_word(std::string_view& text) {
  const auto* const end = std::find_if_not(text.begin(), text.end(), is_word);
  const auto length = static_cast<std::size_t>(end - text.begin());
  const std::string_view word = text.substr(0, length);
  text.remove_prefix(length);
  return word;
}

/// The value of a condition: integers, macros, defined, and C's operators by their precedence.
class Condition {
 public:
  Condition(std::string_view text, const Macros& macros) : text_(text), macros_(macros) {}

  std::int64_t value() { return binary(0); }

 private:
  struct Operator {
    std::string_view name;
    int precedence;
  };
  static constexpr Operator kOperators[] = {{"||", 0}, {"&&", 1}, {"==", 4},
                                            {"!=", 4}, {"|", 2},  {"&", 3}};

  const Operator* next_operator() {
    text_ = trimmed(text_);
    for (const Operator& known : kOperators) {
      if (text_.starts_with(known.name)) return &known;
    }
    return nullptr;
  }

  static std::int64_t apply(std::string_view name, std::int64_t a, std::int64_t b) {
    if (name == "||") return a != 0 || b != 0 ? 1 : 0;
    if (name == "&&") return a != 0 && b != 0 ? 1 : 0;
    if (name == "==") return a == b ? 1 : 0;
    if (name == "!=") return a != b ? 1 : 0;
    return name == "|" ? a | b : a & b;
  }

  std::int64_t binary(int lowest) {  // NOLINT(misc-no-recursion): as deep as its parentheses
    std::int64_t left = unary();
    for (const Operator* found = next_operator(); found != nullptr && found->precedence >= lowest;
         found = next_operator()) {
      text_.remove_prefix(found->name.size());
      left = apply(found->name, left, binary(found->precedence + 1));
    }
    return left;
  }

  std::int64_t unary() {  // NOLINT(misc-no-recursion): the same
    text_ = trimmed(text_);
    if (text_.starts_with('!')) {
      text_.remove_prefix(1);
      return unary() == 0 ? 1 : 0;
    }
    if (!text_.starts_with('(')) return word();
    text_.remove_prefix(1);
    const std::int64_t inner = binary(0);
    text_ = trimmed(text_);
    if (text_.starts_with(')')) text_.remove_prefix(1);
    return inner;
  }

  std::int64_t word() {  // NOLINT(misc-no-recursion): macros name others
    const std::string_view name = take_word(text_);
    if (name == "defined") return is_defined();
    std::int64_t number = 0;
    if (!name.empty() && std::isdigit(static_cast<unsigned char>(name.front())) != 0) {
      std::from_chars(name.data(), name.data() + name.size(), number);
      return number;
    }
    const auto macro = macros_.find(name);
    return macro == macros_.end() ? 0 : Condition(macro->second, macros_).value();
  }

  std::int64_t is_defined() {
    const std::size_t close = text_.find(')');
    std::string_view name = trimmed(text_.substr(0, close));
    if (name.starts_with('(')) name.remove_prefix(1);
    text_.remove_prefix(std::min(close + 1, text_.size()));
    return macros_.contains(trimmed(name)) ? 1 : 0;
  }

  std::string_view text_;
  const Macros& macros_;
};

/// A group from #if to #endif.
struct Group {
  bool is_outer_kept = true;
  bool is_kept = true;
  bool was_kept = true;  ///< this part or one before it
};

class Preprocessor {
 public:
  std::string run(std::string_view text) {
    std::string joined;  // a line and those that a backslash joins to it
    while (!text.empty()) {
      std::string_view line = text.substr(0, text.find('\n'));
      text.remove_prefix(std::min(line.size() + 1, text.size()));
      line = trimmed(line.substr(0, line.find("//")));
      const bool goes_on = line.ends_with('\\');
      if (goes_on) line.remove_suffix(1);
      joined.append(line);
      if (goes_on) continue;
      take_line(joined);
      joined.clear();
    }
    return std::move(kept_);
  }

 private:
  [[nodiscard]] bool is_kept() const { return groups_.empty() || groups_.back().is_kept; }

  void take_line(std::string_view line) {
    if (line.starts_with('#')) {
      take_directive(trimmed(line.substr(1)));
    } else if (is_kept() && !line.empty()) {
      kept_.append(line).append("\n");
    }
  }

  void take_directive(std::string_view line) {
    const std::string_view name = take_word(line);
    line = trimmed(line);
    if (name == "if") begin(is_kept() && Condition(line, macros_).value() != 0);
    if (name == "ifdef") begin(is_kept() && macros_.contains(line));
    if (name == "ifndef") begin(is_kept() && !macros_.contains(line));
    if (name == "elif") go_on(line);
    if (name == "else") go_on("1");
    if (name == "endif" && !groups_.empty()) groups_.pop_back();
    if (name == "define" && is_kept()) {
      const std::string_view macro = take_word(line);
      macros_[std::string(macro)] = trimmed(line);
    }
  }

  void begin(bool kept) { groups_.push_back({is_kept(), kept, kept}); }

  void go_on(std::string_view condition) {
    if (groups_.empty()) return;
    Group& group = groups_.back();
    group.is_kept =
        group.is_outer_kept && !group.was_kept && Condition(condition, macros_).value() != 0;
    group.was_kept = group.was_kept || group.is_kept;
  }

  Macros macros_;
  std::vector<Group> groups_;
  std::string kept_;
};

}  // namespace

std::string preprocess_shader(std::string_view text) {
  return Preprocessor().run(text);
}

std::uint64_t count_shader_lines(std::string_view text) {
  const std::string kept = preprocess_shader(text);
  return static_cast<std::uint64_t>(std::count(kept.begin(), kept.end(), '\n'));
}

}  // namespace relief
