// What a user is told when something can't be done.
#pragma once

#include <fmt/core.h>

#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace relief {

/// One sentence for the user: what is wrong, where (file, line or byte), what to do.
struct Error {
  std::string message;
};

/// Makes an Error from a format string.
template <class... Args>
[[nodiscard]] Error make_error(fmt::format_string<Args...> text, Args&&... args) {
  return Error{fmt::format(text, std::forward<Args>(args)...)};
}

/// A value, or the reason why there is none. Never a half-filled value.
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

/// Done, or the reason why not.
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
