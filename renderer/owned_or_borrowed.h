// Something large that is either one's own or somebody else's.
#pragma once

#include <optional>
#include <utility>

namespace relief {

/// Made from a reference it borrows, which must outlive it; made from a value it owns. Does not
/// move.
template <class T>
class OwnedOrBorrowed {
 public:
  explicit OwnedOrBorrowed(const T& borrowed) : value_(&borrowed) {}
  explicit OwnedOrBorrowed(T&& owned) : own_(std::move(owned)), value_(&*own_) {}
  OwnedOrBorrowed(const OwnedOrBorrowed&) = delete;
  OwnedOrBorrowed& operator=(const OwnedOrBorrowed&) = delete;

  const T& operator*() const { return *value_; }

 private:
  std::optional<T> own_;
  const T* value_;
};

}  // namespace relief
