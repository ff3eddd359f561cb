// Errors as values: Error, Result and Status.
#pragma once

#include <fmt/core.h>

#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace relief {

/// One sentence for the user: what is wrong, where (file, line or byte), what was found, what to
/// do.
struct Error {
  std::string message;
};

/// Makes an Error from a format string.
template <class... Args>
[[nodiscard]] Error make_error(fmt::format_string<Args...> text, Args&&... args) {
  return Error{fmt::format(text, std::forward<Args>(args)...)};
}

/// A value or an Error. Never a partial value.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::move(value)) {}      // NOLINT: implicit on purpose, `return value;`
  Result(Error error) : state_(std::move(error)) {}  // NOLINT: implicit on purpose, `return error;`

  [[nodiscard]] explicit operator bool() const { return std::holds_alternative<T>(state_); }
  [[nodiscard]] T& operator*() & { return get(); }
  [[nodiscard]] const T& operator*() const& { return std::get<T>(state_); }
  [[nodiscard]] T&& operator*() && { return std::move(get()); }
  [[nodiscard]] T* operator->() { return &get(); }
  [[nodiscard]] const T* operator->() const { return &std::get<T>(state_); }
  [[nodiscard]] const Error& error() const { return std::get<Error>(state_); }

 private:
  T& get() {
    assert(*this && "a Result is tested before its value is used");
    return std::get<T>(state_);
  }
  std::variant<T, Error> state_;
};

/// Success or an Error.
class [[nodiscard]] Status {
 public:
  Status() = default;
  Status(Error error) : error_(std::move(error)), ok_(false) {}  // NOLINT: implicit on purpose

  [[nodiscard]] explicit operator bool() const { return ok_; }
  [[nodiscard]] const Error& error() const { return error_; }

 private:
  Error error_;
  bool ok_ = true;
};

}  // namespace relief

// NOLINTBEGIN(cppcoreguidelines-macro-usage): a function can't return from its caller.

/// Returns the error of a Status or Result from the enclosing function; continues otherwise.
#define RELIEF_TRY(...)                                                                      \
  do {                                                                                       \
    if (const auto relief_tried = (__VA_ARGS__); !relief_tried) return relief_tried.error(); \
  } while (false)

/// Declares a variable with the value of a Result, as in `RELIEF_TRY_ASSIGN(const auto file,
/// read_file(path));`. Returns the Result's error from the enclosing function if it has no value.
#define RELIEF_TRY_ASSIGN(declaration, ...) \
  RELIEF_TRY_ASSIGN_AS(RELIEF_JOIN(relief_tried_, __LINE__), declaration, __VA_ARGS__)
#define RELIEF_TRY_ASSIGN_AS(tried, declaration, ...) \
  auto tried = (__VA_ARGS__);                         \
  if (!tried) return tried.error();                   \
  declaration = *std::move(tried)
#define RELIEF_JOIN(a, b) RELIEF_JOIN_NOW(a, b)
#define RELIEF_JOIN_NOW(a, b) a##b

// NOLINTEND(cppcoreguidelines-macro-usage)
