#include "common/scene/json/json_text.h"

#include <algorithm>
#include <optional>
#include <set>
#include <vector>

#include "common/guard.h"

namespace relief {
namespace {

/// Reads the text once before a tree is made of it: the tree's builder would keep the last of
/// repeated keys, nest without limit, and not say where a number is too large.
class Checker final : public nlohmann::json_sax<nlohmann::json> {
 public:
  Checker(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  bool null() override { return true; }
  bool boolean(bool /*value*/) override { return true; }
  bool number_integer(number_integer_t /*value*/) override { return true; }
  bool number_unsigned(number_unsigned_t /*value*/) override { return true; }
  bool number_float(number_float_t /*value*/, const string_t& /*text*/) override { return true; }
  bool string(string_t& /*value*/) override { return true; }
  bool binary(binary_t& /*value*/) override { return true; }
  bool start_array(std::size_t /*elements*/) override { return open(); }
  bool end_array() override { return close(); }
  bool start_object(std::size_t /*elements*/) override { return open(); }
  bool end_object() override { return close(); }
  bool key(string_t& name) override {
    if (keys_.back().insert(name).second) return true;
    // As JSON, so that nothing in it reaches the terminal as it is; cut, for it may be long.
    const std::string shown = nlohmann::json(name.substr(0, 40))
                                  .dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
    error_ = make_error("{}: an object has the key {} twice", name_, shown);
    return false;
  }
  bool parse_error(std::size_t position, const std::string& /*last_token*/,
                   const nlohmann::json::exception& error) override {
    // "[json.exception...] parse error at line 1, column 2: WHAT; last read: 'TOKEN'"
    std::string what = error.what();
    if (const auto column = what.find("column "); column != std::string::npos) {
      what.erase(0, what.find(": ", column) + 2);
    } else {
      what.erase(0, what.find("] ") + 2);
    }
    what.erase(std::min(what.find("; last read"), what.size()));
    const std::string_view before = text_.substr(0, position > 0 ? position - 1 : 0);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t column = before.size() - (before.rfind('\n') + 1) + 1;
    error_ = make_error("{}: line {}, column {}: is no JSON: {}", name_, line, column, what);
    return false;
  }

  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

 private:
  bool open() {
    keys_.emplace_back();
    if (keys_.size() <= kMaxJsonDepth) return true;
    error_ = make_error("{}: is nested deeper than {} levels", name_, kMaxJsonDepth);
    return false;
  }
  bool close() {
    keys_.pop_back();
    return true;
  }

  std::string_view text_;
  const std::string& name_;
  std::vector<std::set<std::string>> keys_;  ///< of the objects (and arrays) that are open
  std::optional<Error> error_;
};

}  // namespace

Result<nlohmann::json> parse_json(std::string_view text, const std::string& name) {
  return guarded({.subject = name,
                  .task = "read it",
                  .library = "nlohmann-json",
                  .advice = "check that the file is valid JSON",
                  .memory_advice = kMoreMemory},
                 [&]() -> Result<nlohmann::json> {
                   Checker checker(text, name);
                   if (!nlohmann::json::sax_parse(text, &checker)) return *checker.error();
                   return nlohmann::json::parse(text);
                 });
}

bool is_utf8(const nlohmann::json& tree) {
  try {
    (void)tree.dump();  // throws unless it is
    return true;
  } catch (const nlohmann::json::exception&) {
    return false;
  }
}

}  // namespace relief
