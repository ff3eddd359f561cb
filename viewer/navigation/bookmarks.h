// Cameras with names, which a viewer comes back to.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "common/scene/camera.h"

namespace relief {

/// Seconds to the next bookmark, of a camera path.
inline constexpr double kBookmarkSeconds = 2.0;

/// A camera with a name.
struct Bookmark {
  std::string name;
  Camera camera;
  double seconds = kBookmarkSeconds;  ///< to the next one, above 0

  bool operator==(const Bookmark&) const = default;
};

/// A list of bookmarks, of which one may be selected. Names differ and are not empty. All indices
/// are below size().
class Bookmarks {
 public:
  /// Adds a bookmark at the end, selects it and returns its index. A name that is taken gets a
  /// number; an empty one becomes "view".
  std::size_t add(const std::string& name, const Camera& camera);

  /// Replaces all bookmarks; none is selected. Names become different as those of add().
  void assign(std::vector<Bookmark> list);

  /// Removes a bookmark. If it was selected, none is afterwards.
  void remove(std::size_t index);

  /// Renames a bookmark; a name that another one has gets a number.
  void rename(std::size_t index, const std::string& name);

  void set_seconds(std::size_t index, double seconds);
  void replace(std::size_t index, const Camera& camera);
  void move(std::size_t from, std::size_t to);  ///< changes the order, e.g. of a camera path

  void select(std::optional<std::size_t> index);
  [[nodiscard]] std::optional<std::size_t> selected() const { return selected_; }

  /// Selects the next or previous bookmark, round the end; the first or last one if none is
  /// selected. Returns its index; none without bookmarks.
  std::optional<std::size_t> select_next();
  std::optional<std::size_t> select_previous();

  [[nodiscard]] const std::vector<Bookmark>& list() const { return list_; }
  [[nodiscard]] std::size_t size() const { return list_.size(); }
  [[nodiscard]] bool empty() const { return list_.empty(); }

 private:
  std::vector<Bookmark> list_;
  std::optional<std::size_t> selected_;
};

}  // namespace relief
