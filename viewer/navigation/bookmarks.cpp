#include "viewer/navigation/bookmarks.h"

#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>

namespace relief {
namespace {

/// The name, or with a number if one of the bookmarks but that at `own` has it.
std::string free_name(const std::vector<Bookmark>& list, const std::string& name, std::size_t own) {
  const std::string wanted = name.empty() ? "view" : name;
  const auto is_taken = [&](const std::string& n) {
    for (std::size_t i = 0; i < list.size(); ++i)
      if (i != own && list[i].name == n) return true;
    return false;
  };
  std::string free = wanted;
  for (std::size_t number = 2; is_taken(free); ++number)
    free = fmt::format("{} {}", wanted, number);
  return free;
}

/// Where an element is after another one has moved.
std::size_t after_move(std::size_t index, std::size_t from, std::size_t to) {
  if (index == from) return to;
  if (from < index && index <= to) return index - 1;
  if (to <= index && index < from) return index + 1;
  return index;
}

}  // namespace

std::size_t Bookmarks::add(const std::string& name, const Camera& camera) {
  list_.push_back({free_name(list_, name, list_.size()), camera, kBookmarkSeconds});
  selected_ = list_.size() - 1;
  return *selected_;
}

void Bookmarks::assign(std::vector<Bookmark> list) {
  list_.clear();
  selected_.reset();
  for (Bookmark& bookmark : list) {
    bookmark.name = free_name(list_, bookmark.name, list_.size());
    list_.push_back(std::move(bookmark));
  }
}

void Bookmarks::remove(std::size_t index) {
  assert(index < size());
  list_.erase(list_.begin() + static_cast<std::ptrdiff_t>(index));
  if (selected_ == index) {
    selected_.reset();
  } else if (selected_ && *selected_ > index) {
    --*selected_;
  }
}

void Bookmarks::rename(std::size_t index, const std::string& name) {
  assert(index < size());
  list_[index].name = free_name(list_, name, index);
}

void Bookmarks::set_seconds(std::size_t index, double seconds) {
  assert(index < size() && seconds > 0.0);
  list_[index].seconds = seconds;
}

void Bookmarks::replace(std::size_t index, const Camera& camera) {
  assert(index < size());
  list_[index].camera = camera;
}

void Bookmarks::move(std::size_t from, std::size_t to) {
  assert(from < size() && to < size());
  const auto at = [this](std::size_t i) { return list_.begin() + static_cast<std::ptrdiff_t>(i); };
  if (from < to) {
    std::rotate(at(from), at(from) + 1, at(to) + 1);
  } else {
    std::rotate(at(to), at(from), at(from) + 1);
  }
  if (selected_) selected_ = after_move(*selected_, from, to);
}

void Bookmarks::select(std::optional<std::size_t> index) {
  assert(!index || *index < size());
  selected_ = index;
}

std::optional<std::size_t> Bookmarks::select_next() {
  if (empty()) return std::nullopt;
  selected_ = selected_ ? (*selected_ + 1) % size() : 0;
  return selected_;
}

std::optional<std::size_t> Bookmarks::select_previous() {
  if (empty()) return std::nullopt;
  selected_ = (selected_.value_or(0) + size() - 1) % size();
  return selected_;
}

}  // namespace relief
